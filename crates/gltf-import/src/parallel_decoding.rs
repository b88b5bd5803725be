//! Parallel image decoding on all processors, while the geometry is read.
//!
//! Threads take images from a shared queue and store results by index, so it makes no difference
//! which thread decodes which image. The thread that reads the geometry helps once it is done.
//! Scoped threads borrow the encoded bytes and end with the call. Each thread decodes whole images,
//! so one large image occupies a single thread.

use super::image_decoder;
use super::image_decoder::EncodedImage;
use model::{Image, Timings};
use std::convert::Infallible;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// A decoded image, or a message that explains why decoding failed.
pub(super) type DecodeResult = Result<Image, String>;

/// Decodes images on all processors.
///
/// The calling thread takes part; the results are in the order of `encoded`.
pub(crate) fn decode_images(encoded: &[EncodedImage<'_>]) -> Vec<DecodeResult> {
    let Ok(((), decoded)) =
        decode_images_alongside(encoded, &Timings::default(), || Ok::<_, Infallible>(()));
    decoded
}

/// Runs `work` while other threads decode images, then helps with the rest, which is timed as
/// `images`. If the work fails, no further images are decoded.
///
/// With a single processor no threads are started, and the images are decoded after the work.
///
/// # Errors
/// Returns the error from `work`. Failed images become messages in the result.
pub(super) fn decode_images_alongside<T, E>(
    encoded: &[EncodedImage<'_>],
    timings: &Timings,
    work: impl FnOnce() -> Result<T, E>,
) -> Result<(T, Vec<DecodeResult>), E> {
    let queue = DecodeQueue::new(encoded);
    let processors = thread::available_parallelism().map_or(1, usize::from);
    let done = thread::scope(|scope| {
        let others = processors.saturating_sub(1).min(encoded.len());
        let others: Vec<_> =
            (0..others).map(|_| scope.spawn(|| queue.decode_until_empty())).collect();
        let done = work();
        timings.measure("images", || {
            if done.is_err() {
                queue.stop_queue();
            }
            queue.decode_until_empty();
            others.into_iter().for_each(|thread| drop(thread.join()));
        });
        done
    });
    Ok((done?, queue.into_results()))
}

/// A queue from which each thread takes the next image.
///
/// The counter hands out each index once, and each result has a separate lock, which is never
/// contended.
struct DecodeQueue<'a> {
    /// The images to decode.
    encoded: &'a [EncodedImage<'a>],
    /// Index of the next image that no thread has taken.
    next: AtomicUsize,
    /// Results by index, or `None` if a thread panicked.
    results: Vec<Mutex<Option<DecodeResult>>>,
}

impl<'a> DecodeQueue<'a> {
    /// Creates a queue of all images.
    fn new(encoded: &'a [EncodedImage<'a>]) -> Self {
        let results = encoded.iter().map(|_| Mutex::new(None)).collect();
        Self { encoded, next: AtomicUsize::new(0), results }
    }

    /// Decodes images until the queue is empty.
    fn decode_until_empty(&self) {
        loop {
            let at = self.next.fetch_add(1, Ordering::Relaxed);
            let Some(image) = self.encoded.get(at) else { break };
            let decoded = image_decoder::decode_rgba(&image.bytes);
            if let Ok(mut slot) = self.results[at].lock() {
                *slot = Some(decoded);
            }
        }
    }

    /// Prevents threads from taking more images.
    fn stop_queue(&self) {
        self.next.store(self.encoded.len(), Ordering::Relaxed);
    }

    /// Returns the results in the order of the images.
    ///
    /// A thread that panics leaves its image without a result, which becomes a message.
    fn into_results(self) -> Vec<DecodeResult> {
        let given_up = || Err("the image was not decoded".to_owned());
        let results = self.results.into_iter().map(|slot| slot.into_inner().ok().flatten());
        results.map(|result| result.unwrap_or_else(given_up)).collect()
    }
}
