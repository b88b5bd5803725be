//! Takes a document that uses everything, and replaces each member with every kind of value or
//! removes it.

use crate::hostile::case::{Case, Expected};
use alberti_tests::gltf::Document;
use serde_json::{Value, json};

pub fn member_cases() -> Vec<Case> {
    let (rich, lavish) = (Document::with_all_members(), Document::with_extensions());
    let mut pointers = Vec::new();
    collect_pointers(&rich.json, &mut String::new(), &mut pointers);
    let mut cases = mutated_cases(&rich, &pointers);
    let mut more = Vec::new();
    collect_pointers(&lavish.json, &mut String::new(), &mut more);
    more.retain(|pointer| !pointers.contains(pointer));
    cases.extend(mutated_cases(&lavish, &more));
    cases
}

/// Returns the document unchanged, and with each of its members corrupted in each way.
fn mutated_cases(document: &Document, pointers: &[String]) -> Vec<Case> {
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
    let mut cases = vec![Case::from_document("everything valid", document, Expected::LoadsClean)];
    for pointer in pointers {
        for value in &values {
            let spoilt = document.clone().with_value(pointer, value.clone());
            cases.push(Case::from_document(
                format!("{pointer} is {value}"),
                &spoilt,
                Expected::Anything,
            ));
        }
        cases.push(Case::from_document(
            format!("{pointer} removed"),
            &document.clone().without_value(pointer),
            Expected::Anything,
        ));
    }
    cases
}

/// Collects the JSON pointers of all values below the root.
fn collect_pointers(value: &Value, path: &mut String, pointers: &mut Vec<String>) {
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
        collect_pointers(value, path, pointers);
        path.truncate(length);
    }
}
