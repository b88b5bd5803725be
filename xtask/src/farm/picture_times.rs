//! The measured distribution of picture times.

use serde_json::Value;

/// Milliseconds per picture for 129 models at 256×256, on one otherwise idle core. The models range
/// from a triangle to 10 MB files with large textures.
const MEASURED: [f64; 129] = [
    0.9, 1.1, 1.1, 1.2, 1.7, 1.7, 1.8, 1.8, 1.8, 1.8, 1.8, 1.9, 2.1, 2.3, 2.3, 2.3, 2.4, 2.4, 2.5,
    2.6, 2.6, 2.7, 2.7, 2.7, 2.7, 2.8, 2.8, 2.8, 2.9, 3.0, 3.0, 3.0, 3.3, 3.6, 3.6, 3.7, 3.7, 3.7,
    3.7, 3.8, 3.8, 3.9, 3.9, 3.9, 4.0, 4.0, 4.0, 4.0, 4.1, 4.3, 4.4, 4.4, 4.4, 4.4, 4.5, 4.6, 4.6,
    4.7, 5.0, 5.3, 5.3, 5.4, 5.5, 5.5, 5.5, 5.7, 5.9, 5.9, 6.1, 6.1, 6.1, 6.2, 6.3, 6.6, 6.6, 6.8,
    6.9, 6.9, 6.9, 7.1, 7.3, 8.1, 8.6, 8.9, 9.4, 9.7, 10.5, 10.6, 10.6, 10.8, 10.9, 11.4, 11.5,
    11.7, 11.9, 12.4, 12.5, 12.7, 12.8, 12.9, 13.0, 13.0, 13.1, 13.2, 13.6, 14.4, 15.6, 15.7, 16.4,
    16.7, 16.8, 18.7, 18.7, 19.2, 19.9, 22.5, 29.2, 30.4, 35.4, 41.7, 44.2, 44.4, 54.4, 57.3, 85.8,
    86.4, 92.1, 333.8, 391.7,
];

/// Milliseconds per picture, all equally likely.
pub struct PictureTimes(Vec<f64>);

impl PictureTimes {
    /// Returns the measured times.
    pub fn measured() -> Self {
        Self(MEASURED.to_vec())
    }

    /// Wraps the given times. Returns `None` if there are none.
    pub fn of(times: &[f64]) -> Option<Self> {
        (!times.is_empty()).then(|| Self(times.to_vec()))
    }

    /// Reads the picture times from a report.
    pub fn from_report(text: &str) -> Result<Self, String> {
        let records = text.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
        let done = records.filter(|record| record["status"] == "done");
        let times: Vec<f64> =
            done.filter_map(|record| Some(record["seconds"].as_f64()? * 1000.0)).collect();
        Self::of(&times).ok_or_else(|| "the report has no finished picture".to_owned())
    }

    /// Returns one of the times, selected by a number from 0 to 1.
    pub fn time_at(&self, share: f64) -> f64 {
        let last = self.0.len() - 1;
        self.0[((share * self.0.len() as f64) as usize).min(last)]
    }

    /// Returns the mean time.
    pub fn mean(&self) -> f64 {
        self.0.iter().sum::<f64>() / self.0.len() as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_times_are_equally_likely() {
        let times = PictureTimes::of(&[4.0, 1.0]).expect("times");
        assert_eq!([0.0, 0.49, 0.5, 0.99].map(|share| times.time_at(share)), [4.0, 4.0, 1.0, 1.0]);
        assert_eq!(times.mean(), 2.5);
        assert!(PictureTimes::of(&[]).is_none());
    }

    #[test]
    fn times_are_read_from_a_report() {
        let report = "{\"status\":\"done\",\"seconds\":0.5}\n{\"status\":\"failed\",\"seconds\":9}\n{\"status\":\"done\",\"seconds\":1.5}\n{\"sta";
        assert_eq!(PictureTimes::from_report(report).expect("times").mean(), 1000.0);
        assert!(PictureTimes::from_report("").is_err());
    }
}
