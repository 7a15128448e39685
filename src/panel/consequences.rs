//! What a change takes with it: keys that another model, another kind or another form has no use for would be errors.

use super::Panel;
use super::sections::here;
use crate::scene::{Address, Alternative, Field, Part, Value};

/// The key that says which other keys and tables may stand beside it.
const MODEL: &str = "model";
/// The same of a wave.
const KIND: &str = "kind";

impl Panel {
    /// `key` of the table at `address`, a `path`, was set or taken out: what is at odds with it now goes.
    pub(super) fn follow(&mut self, parts: &[Part], address: &Address, path: &str, key: &str) {
        match key {
            MODEL => self.leave_out_of_model(parts, address, path),
            KIND => self.leave_out_of_kind(parts, address, path),
            _ => {}
        }
        self.keep_one_form(parts, address, path, key);
    }

    /// The table at `address` has another model now: what that one does not know would be an error.
    fn leave_out_of_model(&mut self, parts: &[Part], address: &Address, path: &str) {
        let model = self.model_of(parts, address, path);
        let here: Vec<&Part> = here(parts, path, model.as_deref()).collect();
        self.document.retain(address, |name| {
            here.iter().any(|part| {
                part.children.contains(&name) || part.fields.iter().any(|field| field.name == name)
            })
        });
        // One of the same name may stand there with other keys in it.
        for child in
            parts.iter().filter(|part| part.path.rsplit_once('.').is_some_and(|(around, _)| around == path))
        {
            let name = child.path.rsplit('.').next().unwrap_or_default();
            if child.model.is_some() && self.document.get(&address.table(name), MODEL).is_none() {
                let inner = address.table(name);
                let known: Vec<&Part> = self::here(parts, child.path, model.as_deref()).collect();
                self.document.retain(&inner, |key| {
                    known.iter().any(|part| part.fields.iter().any(|field| field.name == key))
                });
            }
        }
    }

    /// The table at `address` has another kind now.
    fn leave_out_of_kind(&mut self, parts: &[Part], address: &Address, path: &str) {
        let kind = self.kind_of(parts, address, path);
        let fields: Vec<&Field> = fields(parts, path).collect();
        self.document.retain(address, |name| {
            fields.iter().all(|field| field.name != name || field.is_for(kind.as_deref()))
        });
    }

    /// Where keys say the same in two ways, those of `key` stay, and have what they need beside them.
    fn keep_one_form(&mut self, parts: &[Part], address: &Address, path: &str, key: &str) {
        let mut alternatives =
            parts.iter().filter(|part| part.path == path).filter_map(|part| part.alternative);
        let Some(Alternative { kind, alone, together }) = alternatives.next() else { return };
        let pair = together.map(|(key, _)| key);
        let is_about = key == KIND || key == alone || pair.contains(&key);
        if !is_about || self.kind_of(parts, address, path).as_deref() != Some(kind) {
            return;
        }
        let has = |key: &str| self.document.get(address, key).is_some();
        let wants_pair = match key {
            KIND => !has(alone) && pair.iter().any(|key| has(key)),
            _ => key != alone && has(key),
        };
        if wants_pair {
            self.document.unset(address, alone);
            for (key, first) in together {
                if self.document.get(address, key).is_none() {
                    self.document.set(address, key, &Value::Number(first));
                }
            }
        } else {
            pair.iter().for_each(|key| self.document.unset(address, key));
        }
    }

    /// The model of the table at `address`, a `path`, or else of the table around it.
    pub(super) fn model_of(&self, parts: &[Part], address: &Address, path: &str) -> Option<String> {
        let own = fields(parts, path).find(|field| {
            field.name == MODEL && parts.iter().any(|part| part.path == path && part.model.is_some())
        });
        match own {
            Some(field) => self.word(address, field),
            None => {
                let (around, _) = path.rsplit_once('.')?;
                self.model_of(parts, &address.parent(), around)
            }
        }
    }

    /// The kind of the table at `address`, a `path`, if such a table has one.
    pub(super) fn kind_of(&self, parts: &[Part], address: &Address, path: &str) -> Option<String> {
        let field = fields(parts, path).find(|field| field.name == KIND)?;
        self.word(address, field)
    }

    /// The word that `field` has in the table at `address`, or the one that holds without.
    fn word(&self, address: &Address, field: &Field) -> Option<String> {
        match self.document.get(address, field.name).or_else(|| field.default.clone()) {
            Some(Value::Text(word)) => Some(word),
            _ => None,
        }
    }
}

/// Keys of the section `path` with every model.
fn fields<'p>(parts: &'p [Part], path: &str) -> impl Iterator<Item = &'p Field> {
    parts.iter().filter(move |part| part.path == path).flat_map(|part| &part.fields)
}
