//! Identifies a 4×4 matrix and reports whether it looks like a known misprint.
//!
//! ```text
//! cargo run -p alberti-recognition --example doctor                 the slides' Ortho, as printed
//! cargo run -p alberti-recognition --example doctor -- 1 0 0 0 …    sixteen numbers, row by row
//! ```

#![allow(clippy::print_stdout, reason = "examples write to standard output")]

use recognition::recognize;

/// Ortho(−1, 3, −2, 1, 2, 6), with +(far + near)/(far − near) instead of −(far + near)/(far − near)
/// at the end of the third row.
const SLIDE: [f64; 16] =
    [0.5, 0.0, 0.0, -0.5, 0.0, 2.0 / 3.0, 0.0, 1.0 / 3.0, 0.0, 0.0, -0.5, 2.0, 0.0, 0.0, 0.0, 1.0];

fn main() {
    let given: Vec<f64> =
        std::env::args().skip(1).filter_map(|number| number.parse().ok()).collect();
    let entries: [f64; 16] = given.try_into().unwrap_or(SLIDE);
    let rows = [0, 4, 8, 12].map(|first| [0, 1, 2, 3].map(|column| entries[first + column]));
    show("The matrix", rows);

    let found = recognize(rows);
    println!("Possible readings:");
    for reading in found.readings.iter().take(4) {
        println!("  {:?}, times {} (cost {})", reading.meaning, reading.factor, reading.cost);
    }
    for suspicion in &found.suspicions {
        let misprint = suspicion.misprint;
        let id = misprint.id().unwrap_or("unnumbered");
        println!("{:?}: a misprint ({id}): {}.", suspicion.strength, misprint.description());
        println!("Remedy: {}.", misprint.remedy());
        if let Some(remedied) = suspicion.remedied {
            show("The matrix without the misprint", remedied);
        }
    }
}

fn show(title: &str, rows: [[f64; 4]; 4]) {
    println!("{title}:");
    for [a, b, c, d] in rows {
        println!("  {a:9.4} {b:9.4} {c:9.4} {d:9.4}");
    }
}
