//! From the text of a scene file to a checked [`Scene`]: parse, read every section, check what keys say together.
use super::draft::{Blank, CascadeDraft, SeaDraft, SeaModel, SkyDraft, SkyModel, StillWater};
use super::error::{Place, SceneError};
use super::key::Key;
use super::models::{self, ModelDraft};
use super::reader::{Reader, excerpt};
use super::{CameraSettings, Scene, SkySettings, SkySource, WaterSettings, schema, tessellation};
use crate::raft::{BuoySettings, MAX_BUOYS, RaftSettings};
use crate::sea::settings::MAX_CASCADES;
use crate::sea::{CascadeSettings, FoamSettings, SeaSettings, split_bands};
use std::ops::Range;
use std::path::Path;
use toml::de::DeTable;

/// Reads the scene in `text`; `file` names it in errors, and relative paths in it start from its folder.
pub(super) fn assemble(text: &str, file: &str) -> Result<Scene, SceneError> {
    let document = DeTable::parse(text).map_err(|error| {
        let span = error.span().unwrap_or(0..0);
        let near = match excerpt(text, span.clone()) {
            near if near.is_empty() => "the end of the line".to_owned(),
            near => near,
        };
        SceneError::Syntax {
            place: Place::of(file, text, span.start),
            message: error.message().to_owned(),
            near,
        }
    })?;
    let root = document.get_ref();
    let mut reader = Reader::new(file, text);
    reader.check_names("", root, &[], &["sea", "layer", "lod", "sky", "water", "camera", "raft", "buoy"]);

    let sea = read_sea(&mut reader, root);
    let sky = read_sky(&mut reader, root, file);
    let water: WaterSettings = read_section(&mut reader, root, "water", schema::WATER);
    let camera = read_camera(&mut reader, root);
    let lod = tessellation::read_lod(&mut reader, root);
    let raft: RaftSettings = read_section(&mut reader, root, "raft", schema::RAFT);
    let buoys = read_buoys(&mut reader, root);
    let warnings = reader.finish()?;

    let lod = tessellation::settings(lod, &sea);
    Ok(Scene { sea, lod, sky, water, camera, raft, buoys, warnings })
}

/// A value with all defaults of `keys`.
pub(super) fn defaults<T: Blank>(keys: &[Key<T>]) -> T {
    let mut value = T::BLANK;
    for key in keys {
        key.apply_default(&mut value);
    }
    value
}

pub(super) fn names<T>(keys: &[Key<T>]) -> Vec<&'static str> {
    keys.iter().map(|key| key.name).collect()
}

/// A section of which one table of keys says everything.
fn read_section<T: Blank>(reader: &mut Reader<'_>, root: &DeTable<'_>, name: &str, keys: &[Key<T>]) -> T {
    let mut value = defaults(keys);
    if let Some(table) = reader.table("", root, name) {
        reader.check_names(name, table, &names(keys), &[]);
        reader.read(name, table, keys, &mut value);
    }
    value
}

fn read_sea(reader: &mut Reader<'_>, root: &DeTable<'_>) -> SeaSettings {
    let mut any: SeaDraft = defaults(schema::ANY_SEA);
    let table = reader.table("", root, "sea");
    if let Some(table) = table {
        reader.read("sea", table, schema::ANY_SEA, &mut any);
    }
    let mut drafts = Vec::new();
    let mut sea = match any.model {
        SeaModel::Fft => read_spectral(reader, table),
        SeaModel::Waves | SeaModel::Fbm => read_formulas(reader, root, table, any.model, &mut drafts),
    };
    models::read_layers(reader, root, &mut drafts);
    let loops_span = table.and_then(|table| table.get("loops")).map_or(0..0, |item| item.span());
    sea.gravity = any.gravity;
    sea.models = models::build(reader, drafts, &any, loops_span);
    sea
}

/// `[sea]` with a model that is no spectrum; the model is added to `drafts`.
fn read_formulas(
    reader: &mut Reader<'_>,
    root: &DeTable<'_>,
    table: Option<&DeTable<'_>>,
    model: SeaModel,
    drafts: &mut Vec<ModelDraft>,
) -> SeaSettings {
    let mut water: StillWater = defaults(schema::STILL_WATER);
    if let Some(table) = table {
        let fbm = model == SeaModel::Fbm;
        let mut own = [names(schema::ANY_SEA), names(schema::STILL_WATER)].concat();
        own.extend(fbm.then(|| names(schema::FBM)).into_iter().flatten());
        reader.check_names("sea", table, &own, if fbm { &["foam"] } else { &["wave"] });
        reader.read("sea", table, schema::STILL_WATER, &mut water);
        drafts.push(if fbm {
            let span = root.get("sea").map_or(0..0, |item| item.span());
            models::read_fbm(reader, "sea", table, span)
        } else {
            models::read_waves(reader, "sea", table)
        });
    }
    SeaSettings {
        foam: defaults(schema::FOAM),
        cascades: vec![CascadeSettings::flat(water.roughness)],
        spectral: false,
        ..defaults(schema::SEA)
    }
}

/// `[sea]` with the model "fft".
fn read_spectral(reader: &mut Reader<'_>, table: Option<&DeTable<'_>>) -> SeaSettings {
    let mut sea = defaults(schema::SEA);
    let mut shared = defaults(schema::SEA_AND_CASCADE);
    let mut foam: FoamSettings = defaults(schema::FOAM);
    let mut cascades = Vec::new();
    if let Some(table) = table {
        let own = [names(schema::ANY_SEA), names(schema::SEA), names(schema::SEA_AND_CASCADE)].concat();
        reader.check_names("sea", table, &own, &["cascade", "foam"]);
        reader.read("sea", table, schema::SEA, &mut sea);
        reader.read("sea", table, schema::SEA_AND_CASCADE, &mut shared);
        if let Some(foam_table) = reader.table("sea", table, "foam") {
            reader.check_names("sea.foam", foam_table, &names(schema::FOAM), &[]);
            reader.read("sea.foam", foam_table, schema::FOAM, &mut foam);
        }
        shared.settings.reference_resolution = shared.settings.resolution;
        for (place_in_file, (cascade, span)) in reader.tables("sea", table, "cascade").into_iter().enumerate()
        {
            if place_in_file == MAX_CASCADES {
                let problem = format!("is one cascade too many: at most {MAX_CASCADES}");
                reader.contradiction("sea.cascade".to_owned(), span, problem);
                break;
            }
            let draft = read_cascade(reader, cascade, &shared, place_in_file);
            let band_span = cascade.get("band").map_or(span.clone(), |band| band.span());
            cascades.push(FoundCascade { draft, span, band_span });
        }
    }
    shared.settings.reference_resolution = shared.settings.resolution;
    sea.foam = foam;
    sea.cascades =
        if cascades.is_empty() { vec![shared.settings] } else { share_wave_numbers(reader, cascades) };
    sea
}

fn read_cascade(
    reader: &mut Reader<'_>,
    table: &DeTable<'_>,
    shared: &CascadeDraft,
    place_in_file: usize,
) -> CascadeDraft {
    let mut cascade = shared.clone();
    // The same numbers in two cascades would make the same waves at two scales.
    cascade.settings.seed += place_in_file as u64;
    let own = [names(schema::CASCADE_ONLY), names(schema::SEA_AND_CASCADE)].concat();
    reader.check_names("sea.cascade", table, &own, &[]);
    reader.read("sea.cascade", table, schema::CASCADE_ONLY, &mut cascade);
    reader.read("sea.cascade", table, schema::SEA_AND_CASCADE, &mut cascade);
    cascade
}

/// A cascade and where it was found.
struct FoundCascade {
    draft: CascadeDraft,
    span: Range<usize>,
    band_span: Range<usize>,
}

/// Orders cascades by descending patch size and gives each its band: its own, or one of those that join.
fn share_wave_numbers(reader: &mut Reader<'_>, mut cascades: Vec<FoundCascade>) -> Vec<CascadeSettings> {
    cascades.sort_by(|a, b| b.draft.settings.patch_size.total_cmp(&a.draft.settings.patch_size));
    let key = || "sea.cascade".to_owned();
    if cascades.iter().any(|cascade| cascade.draft.band.is_some()) {
        for cascade in &mut cascades {
            match cascade.draft.band {
                Some(band) => cascade.draft.settings.band = band,
                None => {
                    let problem =
                        "has no band although another cascade has one; give all of them one or none";
                    reader.contradiction(key(), cascade.span.clone(), problem.to_owned());
                }
            }
        }
        report_overlaps(reader, &cascades);
    } else {
        let patches: Vec<_> =
            cascades.iter().map(|c| (c.draft.settings.patch_size, c.draft.settings.resolution)).collect();
        for (cascade, band) in cascades.iter_mut().zip(split_bands(&patches)) {
            cascade.draft.settings.band = band;
            if band[0] >= band[1] {
                let problem = format!(
                    "of {} m has no wave numbers left beside larger patches; make it smaller or give every cascade a band",
                    cascade.draft.settings.patch_size
                );
                reader.contradiction(key(), cascade.span.clone(), problem);
            }
        }
    }
    cascades.into_iter().map(|cascade| cascade.draft.settings).collect()
}

fn report_overlaps(reader: &mut Reader<'_>, cascades: &[FoundCascade]) {
    for (i, earlier) in cascades.iter().enumerate() {
        for later in &cascades[i + 1..] {
            if let (Some(a), Some(b)) = (earlier.draft.band, later.draft.band)
                && a[0] < b[1]
                && b[0] < a[1]
            {
                let problem = format!(
                    "of the patch of {} m overlaps [{}, {}] of the patch of {} m",
                    later.draft.settings.patch_size, a[0], a[1], earlier.draft.settings.patch_size
                );
                reader.contradiction("sea.cascade.band".to_owned(), later.band_span.clone(), problem);
            }
        }
    }
}

fn read_sky(reader: &mut Reader<'_>, root: &DeTable<'_>, file: &str) -> SkySettings {
    let sky: SkyDraft = read_section(reader, root, "sky", schema::SKY);
    let span_of = |name| {
        let item = root.get("sky").and_then(|sky| sky.get_ref().get(name));
        item.map_or(0..0, |item| item.span())
    };
    let source = match (sky.model, sky.file) {
        (SkyModel::Daylight, _) => SkySource::Daylight { turbidity: sky.turbidity, clouds: sky.clouds },
        (SkyModel::Cubemap, Some(name)) => {
            let path = Path::new(file).parent().unwrap_or(Path::new("")).join(&name);
            if !path.is_file() {
                let problem = format!("is not there: no file {}", path.display());
                reader.contradiction("sky.file".to_owned(), span_of("file"), problem);
            }
            SkySource::Cubemap { file: path }
        }
        (SkyModel::Cubemap, None) => {
            let problem = "needs sky.file, the image to show".to_owned();
            reader.contradiction("sky.model".to_owned(), span_of("model"), problem);
            SkySource::Daylight { turbidity: sky.turbidity, clouds: sky.clouds }
        }
    };
    SkySettings {
        source,
        sun_azimuth: sky.sun_azimuth,
        sun_elevation: sky.sun_elevation,
        sun_intensity: sky.sun_intensity,
        exposure: sky.exposure,
        visibility: sky.visibility,
    }
}

fn read_camera(reader: &mut Reader<'_>, root: &DeTable<'_>) -> CameraSettings {
    let camera: CameraSettings = read_section(reader, root, "camera", schema::CAMERA);
    if camera.eye == camera.look
        && let Some(table) = root.get("camera")
        && let Some((name, item)) =
            ["look", "eye"].into_iter().find_map(|name| Some((name, table.get_ref().get(name)?)))
    {
        let other = if name == "look" { "eye" } else { "look" };
        let problem = format!("equals camera.{other}, so there is no direction to look in");
        reader.contradiction(format!("camera.{name}"), item.span(), problem);
    }
    camera
}

fn read_buoys(reader: &mut Reader<'_>, root: &DeTable<'_>) -> Vec<BuoySettings> {
    let tables = reader.tables("", root, "buoy");
    if let Some((_, span)) = tables.get(MAX_BUOYS) {
        let problem = format!("is one buoy too many: at most {MAX_BUOYS}");
        reader.contradiction("buoy".to_owned(), span.clone(), problem);
    }
    let read = |(table, _)| {
        let mut buoy = defaults(schema::BUOY);
        reader.check_names("buoy", table, &names(schema::BUOY), &[]);
        reader.read("buoy", table, schema::BUOY, &mut buoy);
        buoy
    };
    tables.into_iter().take(MAX_BUOYS).map(read).collect()
}
