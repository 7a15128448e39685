//! A widget for each type of key, which gives no value that is out of range.

use crate::scene::{Field, FieldKind, Value};
use egui::{ComboBox, DragValue, Id, Response, Slider, SliderClamping, TextEdit, Ui};

/// Ranges wider than this are no slider's: a pixel of it would be too much.
const WIDEST: f64 = 2e6;
/// Ranges that span this factor are shown by logarithms.
const DECADES: f64 = 500.0;

/// What a key that has no default is first set to.
pub fn first_value(kind: &FieldKind) -> Value {
    match kind {
        FieldKind::Number(_) => Value::Number(1.0),
        FieldKind::Integer([low, _]) => Value::Integer(*low),
        FieldKind::PowerOfTwo([low, _]) => Value::Integer(*low),
        FieldKind::Numbers(_, count) => Value::Numbers(vec![0.0; *count]),
        FieldKind::Color => Value::Numbers(vec![0.5; 3]),
        FieldKind::Band => Value::Numbers(vec![0.0, f64::INFINITY]),
        FieldKind::Word(words) => Value::Text(words.first().copied().unwrap_or_default().to_owned()),
        FieldKind::Path => Value::Text(String::new()),
    }
}

/// Shows `value` of `field`, and returns the widget and what it was changed to.
pub fn show(ui: &mut Ui, field: &Field, value: &Value) -> (Response, Option<Value>) {
    let (response, new) = match (&field.kind, value) {
        (FieldKind::Number(range), Value::Number(number)) => number_widget(ui, field.unit, *range, *number),
        (FieldKind::Integer(range), Value::Integer(number)) => {
            integer_widget(ui, field.unit, *range, *number)
        }
        (FieldKind::PowerOfTwo(range), Value::Integer(number)) => power_widget(ui, field, *range, *number),
        (FieldKind::Numbers(range, _), Value::Numbers(numbers)) => {
            numbers_widget(ui, field.unit, numbers, |_| *range)
        }
        (FieldKind::Band, Value::Numbers(numbers)) => band_widget(ui, field.unit, numbers),
        (FieldKind::Color, Value::Numbers(numbers)) => color_widget(ui, numbers),
        (FieldKind::Word(words), Value::Text(word)) => word_widget(ui, field, words, word),
        (_, Value::Text(text)) => text_widget(ui, field, text),
        _ => (ui.weak(&field.default_text), None),
    };
    (response, new.and_then(|new| field.kind.fit(&new)))
}

fn suffix(unit: &str) -> String {
    if unit.is_empty() { String::new() } else { format!(" {unit}") }
}

/// A number as it was typed; infinity and what is no number are none.
fn finite(text: &str) -> Option<f64> {
    let text: String = text.chars().filter(|letter| !letter.is_whitespace() && *letter != '_').collect();
    text.replace('\u{2212}', "-").parse().ok().filter(|number: &f64| number.is_finite())
}

fn number_widget(ui: &mut Ui, unit: &str, range: [f64; 2], number: f64) -> (Response, Option<Value>) {
    let [low, high] = range;
    let mut now = number;
    let response = if high - low > WIDEST && low < 0.0 {
        let speed = (0.002 * number.abs()).max(0.02);
        ui.add(
            DragValue::new(&mut now)
                .range(low..=high)
                .speed(speed)
                .max_decimals(3)
                .custom_parser(finite)
                .suffix(suffix(unit)),
        )
    } else {
        // From 0 on, or over decades: the small values matter.
        let logarithmic = low >= 0.0 && high >= DECADES * low.max(0.1);
        let smallest = if low > 0.0 { low } else { 1e-3 };
        let slider = Slider::new(&mut now, low..=high)
            .clamping(SliderClamping::Always)
            .logarithmic(logarithmic)
            .smallest_positive(smallest)
            .custom_parser(finite)
            .suffix(suffix(unit));
        ui.add(slider)
    };
    let changed = response.changed();
    (response, changed.then_some(Value::Number(now)))
}

fn integer_widget(ui: &mut Ui, unit: &str, [low, high]: [u64; 2], number: u64) -> (Response, Option<Value>) {
    let mut now = number;
    let response = if high - low > 10_000 {
        ui.add(DragValue::new(&mut now).range(low..=high).speed(0.05).suffix(suffix(unit)))
    } else {
        ui.add(Slider::new(&mut now, low..=high).clamping(SliderClamping::Always).suffix(suffix(unit)))
    };
    let changed = response.changed();
    (response, changed.then_some(Value::Integer(now)))
}

fn power_widget(ui: &mut Ui, field: &Field, [low, high]: [u64; 2], number: u64) -> (Response, Option<Value>) {
    let powers =
        std::iter::successors(Some(low), |power| power.checked_mul(2)).take_while(|power| *power <= high);
    let choices: Vec<(String, Value)> =
        powers.map(|power| (power.to_string(), Value::Integer(power))).collect();
    choose(ui, field, &number.to_string(), choices)
}

fn word_widget(ui: &mut Ui, field: &Field, words: &[&'static str], word: &str) -> (Response, Option<Value>) {
    let choice = |word: &&'static str| ((*word).to_owned(), Value::Text((*word).to_owned()));
    choose(ui, field, word, words.iter().map(choice).collect())
}

/// Where the word `text` of an open list is noted.
pub fn choice_id(text: &str) -> Id {
    Id::new(("choice", text))
}

/// One of `choices`.
fn choose(ui: &mut Ui, field: &Field, now: &str, choices: Vec<(String, Value)>) -> (Response, Option<Value>) {
    let mut chosen = None;
    let combo = ComboBox::from_id_salt(field.name).selected_text(now);
    let shown = combo.show_ui(ui, |ui| {
        for (text, value) in choices {
            let label = ui.selectable_label(text == now, &text);
            ui.data_mut(|data| data.insert_temp(choice_id(&text), label.rect));
            if label.clicked() && text != now {
                chosen = Some(value);
            }
        }
    });
    (shown.response, chosen)
}

fn numbers_widget(
    ui: &mut Ui,
    unit: &str,
    numbers: &[f64],
    range: impl Fn(usize) -> [f64; 2],
) -> (Response, Option<Value>) {
    let mut now = numbers.to_vec();
    let row = ui.horizontal(|ui| {
        let mut all = None::<Response>;
        for (index, number) in now.iter_mut().enumerate() {
            let [low, high] = range(index);
            let speed = (0.005 * number.abs()).clamp(0.002, 1e4);
            let drag =
                DragValue::new(number).range(low..=high).speed(speed).max_decimals(4).custom_parser(finite);
            let one = ui.add(drag.suffix(suffix(unit)));
            all = Some(match all {
                None => one,
                Some(all) => all.union(one),
            });
        }
        all
    });
    let response = row.inner.unwrap_or(row.response);
    let changed = response.changed();
    (response, changed.then_some(Value::Numbers(now)))
}

/// Two ascending numbers: neither is dragged past the other. No end above is infinity, which a button sets.
fn band_widget(ui: &mut Ui, unit: &str, numbers: &[f64]) -> (Response, Option<Value>) {
    let [low, high] = numbers else { return (ui.weak("two numbers"), None) };
    let bounds = [[0.0, (high * 0.999).min(1e6)], [(low * 1.001).max(low + 1e-6), f64::INFINITY]];
    let row = ui.horizontal(|ui| {
        let (response, new) = numbers_widget(ui, unit, numbers, |index| bounds[index.min(1)]);
        let open = ui.small_button("inf").on_hover_text("no end above").clicked();
        (response, if open { Some(Value::Numbers(vec![*low, f64::INFINITY])) } else { new })
    });
    row.inner
}

/// A picker that takes colours as the sea does, linear, and the three numbers.
fn color_widget(ui: &mut Ui, numbers: &[f64]) -> (Response, Option<Value>) {
    let row = ui.horizontal(|ui| {
        let mut rgb: [f32; 3] =
            std::array::from_fn(|part| numbers.get(part).map_or(0.0, |part| *part as f32));
        let picked = ui.color_edit_button_rgb(&mut rgb);
        let (response, typed) = numbers_widget(ui, "", numbers, |_| [0.0, 1.0]);
        let picked_now = picked.changed().then(|| Value::Numbers(rgb.map(f64::from).to_vec()));
        (picked.union(response), picked_now.or(typed))
    });
    row.inner
}

/// A path, which is taken when it is whole: at Enter, or when somebody goes elsewhere.
fn text_widget(ui: &mut Ui, field: &Field, text: &str) -> (Response, Option<Value>) {
    let id = ui.id().with(field.name);
    let mut now = ui.data_mut(|data| data.get_temp::<String>(id)).unwrap_or_else(|| text.to_owned());
    let response = ui.add(TextEdit::singleline(&mut now).hint_text("path").desired_width(200.0));
    if response.has_focus() {
        ui.data_mut(|data| data.insert_temp(id, now));
        return (response, None);
    }
    let left = response.lost_focus();
    ui.data_mut(|data| data.remove_temp::<String>(id));
    (response, (left && now != text).then_some(Value::Text(now)))
}
