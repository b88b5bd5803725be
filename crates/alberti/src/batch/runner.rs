//! Runs the jobs of a batch in parallel, one thread for each, isolated from each other's failures.
//!
//! One thread per picture is faster for many small pictures than all threads on one: loading,
//! decoding and encoding are serial, and take most of the time of a thumbnail.

use super::jobs::BatchJob;
use super::report::{BatchReport, DONE, DONE_BEFORE, FAILED, JobRecord};
use super::{BatchArgs, key::content_key};
use crate::CliError;
use crate::progress::ProgressCounter;
use pipeline::{RenderContext, Renderer, Textures};
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

/// The settings of a run, and the records of earlier ones.
pub(super) struct BatchRun<'a> {
    /// The flags of the command.
    pub(super) args: &'a BatchArgs,
    /// Everything in the flags that changes a picture, as text for the content keys.
    pub(super) settings: &'a str,
    /// The records of earlier runs in the same folder.
    pub(super) earlier: &'a [JobRecord],
    /// The number of jobs that run at a time.
    pub(super) threads: usize,
}

impl BatchRun<'_> {
    /// Runs the jobs that are not up to date; returns the records of all, in the order of the jobs.
    ///
    /// Worker threads take the next job from a shared counter, so that large models do not leave
    /// threads idle.
    ///
    /// The calling thread works as well, so one job needs no further thread. Each worker has a
    /// [`Renderer`] of its own, whose buffers are reused from job to job. Records arrive in any
    /// order and are sorted by the index of their job.
    pub(super) fn run_jobs(&self, jobs: &[&BatchJob], report: &BatchReport) -> Vec<JobRecord> {
        let before: BTreeMap<&str, &JobRecord> = self
            .earlier
            .iter()
            .filter(|record| record.status != FAILED)
            .map(|record| (record.output.as_str(), record))
            .collect();
        let counter = ProgressCounter::start(jobs.len());
        let (next, results) = (AtomicUsize::new(0), Mutex::new(BTreeMap::new()));
        let work = || {
            let mut renderer = Renderer::default();
            loop {
                let at = next.fetch_add(1, Ordering::Relaxed);
                let Some(job) = jobs.get(at) else { break };
                let before = before.get(job.output.as_str()).copied();
                let record = self.run_job(job, before, &mut renderer);
                report.append_record(&record);
                counter.increment();
                if let Ok(mut results) = results.lock() {
                    results.insert(at, record);
                }
            }
        };
        std::thread::scope(|scope| {
            for _ in 1..self.threads.min(jobs.len()) {
                scope.spawn(work);
            }
            work();
        });
        results.into_inner().map(|all| all.into_values().collect()).unwrap_or_default()
    }

    /// Runs one job, unless its picture is up to date.
    ///
    /// A panic is caught and recorded like any other failure: one broken model must not end a run
    /// of thousands.
    ///
    /// The key is taken before rendering: if the model is changed meanwhile, the record has the old
    /// key, and the next run renders it again.
    ///
    /// The assertion of unwind safety holds because the renderer, the only thing a panic can leave
    /// in a broken state, is replaced then.
    fn run_job(
        &self,
        job: &BatchJob,
        before: Option<&JobRecord>,
        renderer: &mut Renderer,
    ) -> JobRecord {
        let key = content_key(
            &job.input,
            self.settings,
            &self.args.load_options.import_options().allow_outside,
        );
        let output = self.args.out_dir.join(&job.output);
        if let Some(before) = before.filter(|before| before.key == key && output.is_file()) {
            return JobRecord { status: DONE_BEFORE.to_owned(), ..before.clone() };
        }
        let begin = Instant::now();
        let work = AssertUnwindSafe(|| self.render_picture(&job.input, &output, renderer));
        let result = catch_unwind(work).unwrap_or_else(|_| {
            // Its buffers may be in any state.
            *renderer = Renderer::default();
            Err(CliError::Usage(
                "internal error: the renderer panicked; please report this as a bug".to_owned(),
            ))
        });
        let (status, warnings, message) = match result {
            Ok(warnings) => (DONE, warnings.len(), warnings.into_iter().next().unwrap_or_default()),
            Err(failure) => (FAILED, 0, failure.to_string()),
        };
        JobRecord {
            input: job.input.to_string_lossy().into_owned(),
            output: job.output.clone(),
            status: status.to_owned(),
            key,
            seconds: begin.elapsed().as_secs_f64(),
            warnings,
            message,
        }
    }

    /// Renders one picture; returns the warnings of its models and of the drawing.
    ///
    /// Rendering is single-threaded, as the jobs themselves are parallel. The folder of the picture
    /// is made only now, so that failed models leave no empty folders.
    ///
    /// # Errors
    /// If the model is invalid, it cannot be rendered, or the picture cannot be written.
    fn render_picture(
        &self,
        input: &Path,
        output: &Path,
        renderer: &mut Renderer,
    ) -> Result<Vec<String>, CliError> {
        let (_, _, scene) = self.args.overrides.open_scene(input, &self.args.load_options)?;
        let textures = Textures::for_scene(&scene);
        let context = RenderContext::new(&scene, &textures, 1);
        let (png, drawing) = renderer.render_png(&context)?;
        if let Some(folder) = output.parent() {
            let fault = |cause| {
                CliError::Usage(format!("cannot create the folder {}: {cause}", folder.display()))
            };
            std::fs::create_dir_all(folder).map_err(fault)?;
        }
        pipeline::write_file(output, &png)?;
        let warnings = scene.models.iter().flat_map(|placed| &placed.model.warnings);
        let warnings = warnings.map(model::Diagnostic::sentence);
        Ok(warnings.chain(drawing.iter().map(ToString::to_string)).collect())
    }
}
