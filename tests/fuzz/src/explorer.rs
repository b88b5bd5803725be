//! Requests to the explorer, as sent by links and the page.

use explorer::Explorer;
use std::cell::RefCell;

/// The maximum number of pixels in a picture; other targets cover all sizes.
const MOST_PIXELS: u64 = 64 * 48;

/// The models in the lessons.
const MODELS: [(&str, &[u8]); 6] = [
    ("models/house.glb", include_bytes!("../../../scenes/models/house.glb")),
    ("models/crate.glb", include_bytes!("../../../scenes/models/crate.glb")),
    ("models/floor.glb", include_bytes!("../../../scenes/models/floor.glb")),
    ("models/mexican_hat.glb", include_bytes!("../../../scenes/models/mexican_hat.glb")),
    (
        "models/mexican_hat_lines.glb",
        include_bytes!("../../../scenes/models/mexican_hat_lines.glb"),
    ),
    ("model.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
];

thread_local! {
    /// One explorer for all requests, as in the program; an error must leave it unchanged.
    static EXPLORER: RefCell<Explorer> = RefCell::new(with_models());
}

fn with_models() -> Explorer {
    let mut explorer = Explorer::new();
    for (name, bytes) in MODELS {
        let added = explorer.add_file(name, bytes.to_vec());
        assert!(added.is_ok(), "{name}: {added:?}");
    }
    explorer
}

/// Answers a query twice and checks that the answers are equal.
pub fn query(bytes: &[u8]) {
    let Ok(query) = std::str::from_utf8(bytes) else { return };
    let query = match pixels(query) {
        Some(pixels) if pixels > MOST_PIXELS => return,
        Some(_) => query.to_owned(),
        None => format!("{query}&size=32x24"),
    };
    EXPLORER.with_borrow_mut(|explorer| {
        let first = explorer.answer(&query);
        match &first {
            Ok(answer) => assert!(!answer.bytes.is_empty(), "an answer is empty"),
            Err(error) => assert!(
                !(error.code.is_empty() || error.message.is_empty() || error.help.is_empty()),
                "empty error message"
            ),
        }
        assert!(explorer.answer(&query) == first, "the second answer differs");
    });
}

/// Returns the size of the picture, if a query specifies it.
fn pixels(query: &str) -> Option<u64> {
    let size = query.split('&').find_map(|pair| pair.strip_prefix("size="))?;
    let sides = size.split(['x', '%']).map(|side| side.parse::<u64>().unwrap_or(0));
    Some(sides.fold(1, u64::saturating_mul))
}
