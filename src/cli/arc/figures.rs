//! Figures of a run, made while its commands come.

use super::Job;
use super::beside::Beside;
use super::blended::{ArcFigures, Blended};
use super::jolt::{Jolt, Jolting};
use super::products::{Differing, ProductsBeside};
use super::projection::projected;
use crate::cli::report::First;
use crate::cli::thinned::Thinned;
use motion_rtl::input::Point;
use motion_rtl::jobs::arc_generator::bounds::segment_error;
use motion_rtl::jobs::arc_generator::job::Command;
use motion_rtl::jobs::arc_generator::measure::{Measured, Measuring, SampleMeasured};
use motion_rtl::jobs::arc_generator::prepared::Shape;

/// The figures of a run.
#[derive(Debug)]
pub struct Figures {
    /// Measurements on the commands; `None` if their number differs from the path's samples.
    pub measured: Option<Measured>,
    /// The arcs that are measured, in order.
    pub arcs: Vec<ArcFigures>,
    /// The first sample that is farther from its exact point than arithmetic and rounding allow.
    pub astray: Option<String>,
    /// Comparison with blends by differences, if the run's blends are made by products.
    pub differing: Option<ProductsBeside>,
    /// Changes of speed, and what they make of the mechanism.
    pub jolt: Jolt,
    /// Tick of the first sample of the second segment.
    pub change: Option<u64>,
    /// The samples, thinned for the picture.
    pub shown: Thinned<Shown, 8>,
    /// Least and largest of each coordinate in mm.
    pub extremes: [[f64; 2]; 3],
    /// First and last point in mm.
    pub ends: Option<[Point; 2]>,
    /// The blend into an arc that leaves it farthest, and as much of the arc.
    pub blended: Option<Blended>,
    /// The arcs by the conventional method.
    pub beside: Beside,
    /// The arcs by the conventional method without ramps.
    pub even: Beside,
}

impl Figures {
    /// Sets the error of the conventional method beside each arc's own.
    pub fn compare_arcs(&mut self) {
        for arc in self.measured.iter_mut().flat_map(|own| &mut own.arcs) {
            let error_mm = self.beside.radius_error(arc.segment);
            arc.conventional_radius_error_um = Some(error_mm * 1e3);
        }
    }

    /// Returns the samples that are shown.
    pub fn samples(&self) -> impl Iterator<Item = &SampleMeasured> {
        self.shown.iter().map(|shown| &shown.measured)
    }

    /// Returns the samples that are shown by segments, each from the last of the one before on.
    pub fn by_segment(&self) -> Vec<(usize, Vec<&SampleMeasured>)> {
        let samples: Vec<_> = self.samples().collect();
        let (mut all, mut last) = (Vec::new(), None);
        for own in samples.chunk_by(|a, b| a.segment == b.segment) {
            all.push((
                own[0].segment,
                last.into_iter().chain(own.iter().copied()).collect(),
            ));
            last = own.last().copied();
        }
        all
    }
}

/// A sample as the picture shows it.
#[derive(Debug, Clone, Copy)]
pub struct Shown {
    pub measured: SampleMeasured,
    /// Radius error in mm, outwards positive; NaN where the segment is no arc.
    radius_error: f64,
}

impl Shown {
    /// The numbers whose extremes a picture shows.
    fn numbers(&self) -> [f64; 8] {
        let SampleMeasured {
            point,
            speed,
            acceleration,
            ..
        } = self.measured;
        let ([x, y, z], (across, up)) = (point, projected(point));
        let [speed, acceleration] = [speed, acceleration].map(|value| value.unwrap_or(f64::NAN));
        [x, y, z, across, up, speed, acceleration, self.radius_error]
    }
}

/// Figures of a run that goes on.
pub struct UnderWay<'j> {
    job: &'j Job,
    measuring: Measuring<'j>,
    bounds: Vec<f64>,
    astray: First,
    differing: Option<Differing<'j>>,
    jolting: Jolting,
    /// Sample at which the second segment begins.
    second: u64,
    figures: Figures,
}

impl<'j> UnderWay<'j> {
    /// Starts the figures of a run.
    pub fn new(job: &'j Job) -> Self {
        let arcs = arcs(job);
        UnderWay {
            job,
            measuring: Measuring::new(&job.prepared, &job.settings),
            bounds: bounds(job),
            astray: First::default(),
            differing: Differing::of(job),
            jolting: Jolting::new(job),
            second: job.change(),
            figures: Figures {
                measured: None,
                astray: None,
                differing: None,
                jolt: Jolt::default(),
                change: None,
                shown: Thinned::by(Shown::numbers),
                extremes: [[f64::INFINITY, f64::NEG_INFINITY]; 3],
                ends: None,
                blended: Blended::of(job, &arcs),
                beside: Beside::default(),
                even: Beside::default(),
                arcs,
            },
        }
    }

    /// Takes the next command.
    pub fn take(&mut self, command: Command) {
        let Some(measured) = self.measuring.take(command.counts) else {
            return;
        };
        let SampleMeasured {
            sample,
            segment,
            point,
            error,
            ..
        } = measured;
        let most = self.bounds[segment];
        // Written so that NaN fails.
        let within = error <= most;
        if !within {
            self.astray.add(|| {
                let (off, most) = (error * 1e3, most * 1e3);
                format!(
                    "sample {sample} is {off:.3} um off its exact point, its bound is {most:.3} um"
                )
            });
        }
        if let Some(differing) = &mut self.differing {
            differing.take(command.counts);
        }
        self.jolting.take(point);
        let figures = &mut self.figures;
        if sample == self.second {
            figures.change = Some(command.tick);
        }
        for ([least, most], mm) in figures.extremes.iter_mut().zip(point) {
            (*least, *most) = (least.min(mm), most.max(mm));
        }
        let first = figures.ends.map_or(point, |[first, _]| first);
        figures.ends = Some([first, point]);
        if let Some(blended) = &mut figures.blended
            && blended.samples.contains(&sample)
        {
            blended.points.push(point);
        }
        let radius_error = match self.job.prepared.segments[segment].shape {
            Shape::Arc { circle, .. } => circle.off(point)[0],
            Shape::Line { .. } | Shape::Blend { .. } => f64::NAN,
        };
        figures.shown.push(Shown {
            measured,
            radius_error,
        });
    }

    /// Figures of the run, without those of the conventional method.
    pub fn finish(self) -> Figures {
        let measured = self.measuring.finish();
        let arcs = match measured {
            Some(_) => self.figures.arcs,
            None => Vec::new(),
        };
        Figures {
            measured,
            arcs,
            astray: self.astray.text(),
            differing: self.differing.map(Differing::finish),
            jolt: self.jolting.finish(),
            ..self.figures
        }
    }
}

/// Returns the error bound of each segment's samples in mm.
fn bounds(job: &Job) -> Vec<f64> {
    let segments = job.prepared.segments.iter();
    let bounds = segments.map(|segment| segment_error(segment, &job.settings));
    bounds.collect()
}

/// The segments that are arcs.
fn arcs(job: &Job) -> Vec<ArcFigures> {
    let segments = job.prepared.segments.iter().enumerate();
    segments
        .filter_map(|(index, segment)| {
            let Shape::Arc { .. } = segment.shape else {
                return None;
            };
            Some(ArcFigures {
                segment: index,
                piece: segment.piece,
                report: job.prepared.pieces.get(segment.piece)?.arc?,
            })
        })
        .collect()
}
