//! Picture statistics: six numbers that reveal lighting problems.

use pipeline::Picture;

/// Statistics of a picture. Covered pixels are at least half opaque.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct PictureStatistics {
    /// The fraction of the picture that is covered.
    pub cover: f64,
    /// The fraction of covered pixels with code 255 in all channels.
    pub white: f64,
    /// The fraction of covered pixels below code 5 in all channels.
    pub black: f64,
    /// The mean code of covered pixels over all channels.
    pub mean: f64,
    /// The difference between the 5th and 95th percentiles of the codes, in the channel where it is
    /// largest.
    pub contrast: u8,
    /// The maximum code in any channel.
    pub brightest: u8,
}

impl PictureStatistics {
    /// Returns the statistics of a picture, which are all 0 if nothing is covered.
    #[must_use]
    pub fn of_picture(picture: &Picture) -> Self {
        let covered = || picture.pixels.iter().filter(|pixel| pixel[3] >= 128);
        let count = covered().count();
        if count == 0 {
            return Self::default();
        }
        let share = |test: fn(u8) -> bool| {
            let matching = covered().filter(|pixel| pixel[..3].iter().all(|&code| test(code)));
            matching.count() as f64 / count as f64
        };
        let channels = [0, 1, 2].map(|channel: usize| {
            let mut codes: Vec<u8> = covered().map(|pixel| pixel[channel]).collect();
            codes.sort_unstable();
            codes
        });
        let percentile = |codes: &Vec<u8>, percent: usize| codes[(count - 1) * percent / 100];
        let greatest = |of_channel: &dyn Fn(&Vec<u8>) -> u8| channels.iter().map(of_channel).max();
        let sum: f64 = channels.iter().flatten().map(|&code| f64::from(code)).sum();
        Self {
            cover: count as f64 / picture.pixels.len() as f64,
            white: share(|code| code == 255),
            black: share(|code| code < 5),
            mean: sum / (3 * count) as f64,
            contrast: greatest(&|codes| percentile(codes, 95) - percentile(codes, 5)).unwrap_or(0),
            brightest: greatest(&|codes| percentile(codes, 100)).unwrap_or(0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transparent_pixels_do_not_count() {
        let mut picture = Picture::default();
        picture.resize(4, 1);
        assert_eq!(PictureStatistics::of_picture(&picture), PictureStatistics::default());
        picture.pixels =
            vec![[255, 255, 255, 255], [4, 0, 1, 255], [10, 20, 30, 200], [255, 255, 255, 20]];
        let statistics = PictureStatistics::of_picture(&picture);
        assert_eq!((statistics.cover, statistics.brightest), (0.75, 255));
        assert_eq!((statistics.white, statistics.black), (1.0 / 3.0, 1.0 / 3.0));
        assert!((statistics.mean - 830.0 / 9.0).abs() < 1e-9, "{statistics:?}");
    }
}
