//! The losses: faster peers and missed goals.

use super::tables::{list, ratio, text};
use serde_json::Value;
use std::fmt::Write as _;

/// Our contestants' names, to which a suffix such as the number of samples may be added.
const OURS: [&str; 3] = ["raster", "render", "alberti"];

/// Formats the section of the page.
pub fn to_markdown(figures: &Value) -> String {
    let mut found = faster_peers(figures);
    for goal in list(&figures["goals"]).iter().filter(|goal| goal["met"] == false) {
        found += &super::tables::goal_row(goal);
    }
    if found.is_empty() {
        return "\n## Losses\n\nNone.\n".into();
    }
    format!(
        "\n## Losses\n\nThese peers take less time than Alberti (the ratio is their time divided by ours), and these goals are missed.\n\n\
         | comparison | measured | goal |\n| --- | --- | --- |\n{found}"
    )
}

/// Formats a row for each peer that is faster than one of our contestants in a scene or with a
/// file.
fn faster_peers(figures: &Value) -> String {
    let mut rows = String::new();
    let scenes = list(&figures["scenes"]).iter().map(|scene| (scene, &scene["name"]));
    let files = list(&figures["files"]).iter().map(|file| (file, &file["model"]));
    for (subject, name) in scenes.chain(files) {
        let peers = list(&subject["contestants"]).iter().filter(|one| !is_ours(one));
        for (peer, whose) in peers.flat_map(|peer| OURS.map(|whose| (peer, whose))) {
            let over = &peer[format!("over_{whose}")];
            if over["median"].as_f64().is_some_and(|median| median < 1.0) {
                let (name, peer) = (text(name), text(&peer["name"]));
                let _ = writeln!(rows, "| {name}, {whose}: {peer} | {} | ≥ 1.00 |", ratio(over));
            }
        }
    }
    rows
}

fn is_ours(contestant: &Value) -> bool {
    let name = text(&contestant["name"]);
    OURS.contains(&name.split([' ', ',']).next().unwrap_or_default())
}
