//! Every member of a document that uses everything, replaced by every kind of value and left out.

use crate::case::{Case, Expected};
use crate::document::Document;
use serde_json::{Value, json};

pub fn cases() -> Vec<Case> {
    let (rich, lavish) = (Document::rich(), Document::lavish());
    let mut pointers = Vec::new();
    collect(&rich.json, &mut String::new(), &mut pointers);
    let mut cases = spoilt(&rich, &pointers);
    let mut more = Vec::new();
    collect(&lavish.json, &mut String::new(), &mut more);
    more.retain(|pointer| !pointers.contains(pointer));
    cases.extend(spoilt(&lavish, &more));
    cases
}

/// A document as it is, and with each of the members spoilt in each way.
fn spoilt(document: &Document, pointers: &[String]) -> Vec<Case> {
    let values = [
        json!(null),
        json!(true),
        json!(0),
        json!(1),
        json!(-1),
        json!(7),
        json!(0.5),
        json!(4_294_967_296u64),
        json!(1e300),
        json!(""),
        json!("x"),
        json!([]),
        json!([0]),
        json!([[[]]]),
        json!({}),
        json!({"x": 0}),
    ];
    let mut cases = vec![Case::of("everything right", document, Expected::LoadsClean)];
    for pointer in pointers {
        for value in &values {
            let spoilt = document.clone().with(pointer, value.clone());
            cases.push(Case::of(format!("{pointer} is {value}"), &spoilt, Expected::Anything));
        }
        cases.push(Case::of(
            format!("no {pointer}"),
            &document.clone().without(pointer),
            Expected::Anything,
        ));
    }
    cases
}

/// The JSON pointers of all values below the top.
fn collect(value: &Value, path: &mut String, pointers: &mut Vec<String>) {
    let members: Vec<(String, &Value)> = match value {
        Value::Array(items) => {
            items.iter().enumerate().map(|(at, v)| (at.to_string(), v)).collect()
        }
        Value::Object(members) => members.iter().map(|(key, v)| (key.clone(), v)).collect(),
        _ => return,
    };
    for (name, value) in members {
        let length = path.len();
        path.push('/');
        path.push_str(&name);
        pointers.push(path.clone());
        collect(value, path, pointers);
        path.truncate(length);
    }
}
