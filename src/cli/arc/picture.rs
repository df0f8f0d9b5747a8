//! The picture of a run.

use super::Job;
use super::figures::Figures;

/// The picture as SVG.
pub fn draw(job: &Job, _: &Figures) -> String {
    motion_rtl::picture::Picture::new(format!("{}: arc generator", job.stem)).render()
}
