//! Variations of a glTF file that remain valid JSON, unlike nearly all random byte changes.

use crate::glb;
use serde_json::{Value, json};
use std::sync::LazyLock;

/// A splitmix64 generator.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, count: usize) -> usize {
        (self.next() >> 32) as usize % count.max(1)
    }
}

/// Returns a variation of the file's JSON with unchanged data, or `None` if the bytes should be
/// changed instead.
pub fn file(file: &[u8], seed: u32) -> Option<Vec<u8>> {
    let mut random = Random(seed.into());
    if random.below(4) == 0 {
        return None;
    }
    let (json, binary) = glb::parts(file);
    let mut document: Value = serde_json::from_slice(json).ok()?;
    for _ in 0..=random.below(4) {
        change(&mut document, &mut random);
    }
    let text = document.to_string();
    let is_binary = file.starts_with(b"glTF");
    Some(if is_binary { glb::glb(text.as_bytes(), binary) } else { text.into_bytes() })
}

/// Returns the number of values, including the value itself.
fn size(value: &Value) -> usize {
    1 + match value {
        Value::Array(elements) => elements.iter().map(size).sum(),
        Value::Object(members) => members.values().map(size).sum(),
        _ => 0,
    }
}

/// Returns the value with this index in depth-first order; the value itself has index 0.
fn nth(value: &mut Value, mut number: usize) -> Option<&mut Value> {
    if number == 0 {
        return Some(value);
    }
    number -= 1;
    let children: Vec<&mut Value> = match value {
        Value::Array(elements) => elements.iter_mut().collect(),
        Value::Object(members) => members.iter_mut().map(|(_, member)| member).collect(),
        _ => Vec::new(),
    };
    for child in children {
        let size = size(child);
        if number < size {
            return nth(child, number);
        }
        number -= size;
    }
    None
}

/// Changes, removes or inserts one value.
fn change(document: &mut Value, random: &mut Random) {
    let count = size(document);
    let other = nth(document, random.below(count)).map(|value| value.clone());
    let Some(value) = nth(document, random.below(count)) else { return };
    let other = other.filter(|other| size(other) < 200).unwrap_or(Value::Null);
    match (value, random.below(8)) {
        (value, 0) => *value = any(random),
        (value, 1) => *value = other,
        (Value::Array(elements), 2 | 3) if !elements.is_empty() => {
            elements.swap_remove(random.below(elements.len()));
        }
        (Value::Array(elements), choice) => {
            let again = elements.get(random.below(elements.len())).cloned();
            elements.push(if choice == 4 { other } else { again.unwrap_or(other) });
        }
        (Value::Object(members), 2 | 3) if !members.is_empty() => {
            let key = members.keys().nth(random.below(members.len())).cloned();
            members.remove(&key.unwrap_or_default());
        }
        (Value::Object(members), choice) => {
            let key = WORDS[random.below(WORDS.len())].to_owned();
            members.insert(key, if choice == 4 { other } else { any(random) });
        }
        (Value::String(text), 2..=6) => *text = WORDS[random.below(WORDS.len())].to_owned(),
        (value @ Value::Number(_), 2..=6) => *value = near(value, random),
        (value, _) => *value = any(random),
    }
}

/// Returns a number near another number.
fn near(number: &Value, random: &mut Random) -> Value {
    let step = [1i64, -1, 2, 4, 100][random.below(5)];
    match (number.as_i64(), number.as_f64()) {
        (Some(whole), _) if random.below(4) > 0 => json!(whole.wrapping_add(step)),
        (_, Some(real)) => json!(real * [2.0, 0.5, -1.0, 1e10, 1e-10][random.below(5)]),
        _ => any(random),
    }
}

fn any(random: &mut Random) -> Value {
    match random.below(26) {
        0 => json!(null),
        1 => json!([]),
        2 => json!({}),
        3 => json!(true),
        4 => json!(-1),
        5 => json!(0.5),
        6 => json!(1e30),
        7 => json!(-1e300),
        8 => json!(1e-40),
        9 => json!(u64::MAX),
        10 => json!(u32::MAX),
        11 => json!(1u64 << 31),
        12 => json!([0]),
        13 => json!([0, 0, 0]),
        14 => json!([1, 1, 1, 1]),
        15 => json!({"index": 0}),
        16..=18 => json!(COMPONENTS[random.below(COMPONENTS.len())]),
        19..=21 => json!(random.below(8)),
        22 => json!(random.below(300)),
        _ => json!(WORDS[random.below(WORDS.len())]),
    }
}

/// Component types, filters, wrap modes and a buffer target.
const COMPONENTS: [u32; 16] = [
    5120, 5121, 5122, 5123, 5125, 5126, 9728, 9729, 9984, 9985, 9986, 9987, 10497, 33071, 33648,
    34962,
];

/// The words of the dictionary, which the fuzzer also uses for its own variations.
static WORDS: LazyLock<Vec<&str>> = LazyLock::new(|| {
    let lines = include_str!("../gltf.dict").lines();
    lines.filter_map(|line| line.strip_prefix('"')?.strip_suffix('"')).collect()
});
