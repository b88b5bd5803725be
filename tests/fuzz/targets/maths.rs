//! Fuzzes every function of the five math crates: makes the calls in `tests/soak`, with arguments
//! from the fuzzer's bytes.
#![no_main]

#[path = "maths/bits.rs"]
mod bits;
#[path = "../../soak/camera.rs"]
mod camera;
#[path = "../../soak/clip.rs"]
mod clip;
#[path = "../../soak/finite.rs"]
mod finite;
#[path = "../../soak/homog.rs"]
mod homog;
#[path = "../../soak/projection.rs"]
mod projection;
#[allow(dead_code, reason = "used by the soak test to begin calls and to record arguments")]
#[path = "../../soak/random.rs"]
mod random;
#[path = "maths/subject.rs"]
mod subject;
#[path = "../../soak/viewport.rs"]
mod viewport;

use bits::Bits;
use libfuzzer_sys::fuzz_target;
use random::Random;
use subject::Subject;

const SUBJECTS: [&[Subject]; 5] =
    [homog::SUBJECTS, camera::SUBJECTS, projection::SUBJECTS, clip::SUBJECTS, viewport::SUBJECTS];

// The first two bytes select the function.
fuzz_target!(|bytes: &[u8]| {
    let Some((&choice, numbers)) = bytes.split_first_chunk() else { return };
    let count: usize = SUBJECTS.iter().map(|subjects| subjects.len()).sum();
    let at = usize::from(u16::from_le_bytes(choice)) % count;
    let Some((name, call)) = SUBJECTS.into_iter().flatten().nth(at) else { return };
    fuzz::case::run(|| {
        let mut random = Random::new(Bits::of(numbers));
        let outcome = call(&mut random);
        let right = outcome != Some(false) || !random.drew_only_finite();
        assert!(right, "{name} returns a number that is not finite, or a wrong result");
    });
});
