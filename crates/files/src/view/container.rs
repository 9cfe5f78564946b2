//! The binary form of what a page is sent: a JSON head and arrays of numbers, which a browser takes as typed
//! arrays without copying.
//!
//! `EMB1`, the length of the head (u32), the head (JSON, filled with spaces to a multiple of 8), the arrays,
//! each at a multiple of 8 behind the head; all little-endian. Made by `bodies` and `frame`.

use serde_json::{Map, Value, json};

/// First bytes.
const MAGIC: &[u8; 4] = b"EMB1";

/// Numbers of an array.
#[derive(Clone, Debug, PartialEq)]
enum Numbers {
    F32(Vec<f32>),
    U32(Vec<u32>),
}

impl Numbers {
    fn count(&self) -> usize {
        match self {
            Self::F32(values) => values.len(),
            Self::U32(values) => values.len(),
        }
    }

    fn kind(&self) -> &'static str {
        match self {
            Self::F32(_) => "f32",
            Self::U32(_) => "u32",
        }
    }

    fn append(&self, bytes: &mut Vec<u8>) {
        match self {
            Self::F32(values) => bytes.extend(values.iter().flat_map(|value| value.to_le_bytes())),
            Self::U32(values) => bytes.extend(values.iter().flat_map(|value| value.to_le_bytes())),
        }
    }
}

/// A head and arrays.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Container {
    head: Map<String, Value>,
    arrays: Vec<(&'static str, Numbers)>,
}

impl Container {
    /// Puts a value into the head. What JSON has no form for (numbers that are not finite) is `null`.
    #[must_use]
    pub fn with(mut self, key: &str, value: impl Into<Value>) -> Self {
        self.head(key, value);
        self
    }

    /// The same, in place.
    pub(super) fn head(&mut self, key: &str, value: impl Into<Value>) {
        self.head.insert(key.into(), value.into());
    }

    /// Adds an array of single precision.
    pub(super) fn floats(&mut self, name: &'static str, values: Vec<f32>) {
        self.arrays.push((name, Numbers::F32(values)));
    }

    /// Adds an array of whole numbers.
    pub(super) fn indices(&mut self, name: &'static str, values: Vec<u32>) {
        self.arrays.push((name, Numbers::U32(values)));
    }

    /// The bytes.
    #[must_use]
    pub fn bytes(&self) -> Vec<u8> {
        let mut head = self.head.clone();
        let mut at = 0;
        let mut places = Map::new();
        for (name, numbers) in &self.arrays {
            places.insert((*name).into(), json!({ "type": numbers.kind(), "offset": at, "count": numbers.count() }));
            at += (4 * numbers.count()).next_multiple_of(8);
        }
        head.insert("arrays".into(), places.into());
        let mut text = Value::Object(head).to_string().into_bytes();
        text.resize(text.len().next_multiple_of(8), b' ');
        let mut bytes = Vec::with_capacity(8 + text.len() + at);
        bytes.extend(MAGIC);
        bytes.extend((text.len() as u32).to_le_bytes());
        bytes.extend(text);
        for (_, numbers) in &self.arrays {
            numbers.append(&mut bytes);
            bytes.resize(bytes.len().next_multiple_of(8), 0);
        }
        bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrays_lie_where_the_head_says() {
        let mut container = Container::default().with("time", 0.25).with("nothing", f64::NAN);
        container.floats("values", vec![1.5, -2.0, f32::NAN]);
        container.indices("nodes", vec![7, 8]);
        let bytes = container.bytes();
        assert_eq!(&bytes[..4], MAGIC);
        let length = u32::from_le_bytes(bytes[4..8].try_into().unwrap()) as usize;
        assert_eq!(length % 8, 0);
        let head: Value = serde_json::from_slice(&bytes[8..8 + length]).unwrap();
        assert_eq!((&head["time"], &head["nothing"]), (&json!(0.25), &Value::Null));
        assert_eq!(head["arrays"]["nodes"], json!({ "type": "u32", "offset": 16, "count": 2 }));
        let at = 8 + length;
        assert_eq!(f32::from_le_bytes(bytes[at + 4..at + 8].try_into().unwrap()), -2.0);
        assert!(f32::from_le_bytes(bytes[at + 8..at + 12].try_into().unwrap()).is_nan());
        assert_eq!(u32::from_le_bytes(bytes[at + 16..at + 20].try_into().unwrap()), 7);
        assert_eq!(bytes.len(), at + 24);
    }
}
