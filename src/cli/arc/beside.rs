//! The arcs of a path on the conventional circuit.

use super::Job;
use super::blended::Blended;
use super::jolt::{Jolt, Jolting};
use crate::cli::Failure;
use motion_rtl::circuits::arc_generator::{Conventional, Widths};
use motion_rtl::input::Point;
use motion_rtl::jobs::arc_generator::beside::{play_each, records};
use motion_rtl::jobs::arc_generator::bounds::conventional_error;
use motion_rtl::jobs::arc_generator::conventional::Conventional as Method;
use motion_rtl::jobs::arc_generator::job::{Command, Played};
use motion_rtl::jobs::arc_generator::prepare::Timing;
use motion_rtl::jobs::arc_generator::prepared::Shape;
use motion_rtl::path::circle::Circle;
use motion_rtl::path::record::Record;
use motion_rtl::path::vector::distance;

/// Arcs by the conventional circuit; empty if there are none or one of them is not run.
#[derive(Debug, Default)]
pub struct Beside {
    /// Each arc from rest to rest.
    pub arcs: Vec<Arc>,
    /// Their samples, each with its start.
    pub samples: u64,
    /// Output of the circuit.
    pub played: Played,
    /// First piece whose arc is not run because it does not fit.
    pub left: Option<usize>,
    /// Radius error in um over the way in mm, at the start of the arc that the picture shows.
    pub start: Vec<(f64, f64)>,
}

/// An arc from rest to rest at a speed.
pub type Run = fn(&Circle, f64, &Timing) -> Method;

/// An arc of a path by the conventional method.
pub struct Planned {
    segment: usize,
    piece: usize,
    circle: Circle,
    method: Method,
}

/// Every arc of a path, as `run` has an arc of its speed, and the records of all; or the first piece
/// whose arc does not fit.
pub fn runs(job: &Job, run: Run) -> Result<(Vec<Planned>, Vec<Record>), usize> {
    let (mut arcs, mut all) = (Vec::new(), Vec::new());
    for (index, segment) in job.prepared.segments.iter().enumerate() {
        let Shape::Arc { circle, .. } = segment.shape else {
            continue;
        };
        let wanted = job.prepared.pieces[segment.piece].wanted;
        let method = run(&circle, wanted, &job.prepared.timing);
        let records = records(&method, job.settings.counts_per_mm, &Widths::FULL);
        all.extend(records.ok_or(segment.piece)?);
        arcs.push(Planned {
            segment: index,
            piece: segment.piece,
            circle,
            method,
        });
    }
    Ok((arcs, all))
}

/// Samples of arcs from rest to rest, each with its start.
pub fn samples(arcs: &[Planned]) -> u64 {
    arcs.iter().map(|arc| 1 + arc.steps()).sum()
}

impl Planned {
    fn steps(&self) -> u64 {
        2 * self.method.ramp + self.method.samples
    }
}

/// An arc from rest to rest.
#[derive(Debug)]
pub struct Arc {
    /// Its segment.
    pub segment: usize,
    /// Its piece.
    pub piece: usize,
    /// Largest distance of a command from its exact point, in mm.
    pub error: f64,
    /// Bound of `error`.
    pub bound: f64,
    /// Largest radius error of a command, in mm.
    pub radius_error: f64,
    /// Changes of speed, and what they make of the mechanism.
    pub jolt: Jolt,
}

/// Figures of an arc whose commands are still coming.
struct UnderWay {
    error: f64,
    radius_error: f64,
    jolting: Jolting,
}

impl UnderWay {
    fn take(&mut self, point: Point, exact: Point, off: f64) {
        self.error = self.error.max(distance(point, exact));
        self.radius_error = self.radius_error.max(off.abs());
        self.jolting.take(point);
    }
}

/// The start of an arc as the picture shows it: radius error in um over the way in mm.
struct Start {
    segment: usize,
    most_mm: f64,
    way_mm: f64,
    last: Option<Point>,
    curve: Vec<(f64, f64)>,
}

impl Start {
    fn take(&mut self, point: Point, off: f64) {
        if let Some(last) = self.last.replace(point) {
            self.way_mm += distance(last, point);
            if self.way_mm <= self.most_mm {
                self.curve.push((self.way_mm, off * 1e3));
            }
        }
    }
}

impl Beside {
    /// Runs every arc of a path, as `method` has an arc of this speed, and takes the start of one for
    /// the picture, as long as the blend into it is shown.
    pub fn run(job: &Job, method: Run, blended: Option<&Blended>) -> Result<Self, Failure> {
        let per_mm = job.settings.counts_per_mm;
        let (planned, all) = match runs(job, method) {
            Ok(all) => all,
            Err(left) => {
                return Ok(Beside {
                    left: Some(left),
                    ..Beside::default()
                });
            }
        };
        let circuit = Conventional::new(job.settings.rounding);
        let mut start = blended.map(|blended| Start {
            segment: blended.arc.segment,
            most_mm: blended.ways().last().copied().unwrap_or(0.0),
            way_mm: 0.0,
            last: None,
            curve: Vec::new(),
        });
        let under_way = |_: &Planned| UnderWay {
            error: 0.0,
            radius_error: 0.0,
            jolting: Jolting::new(job),
        };
        let mut arcs: Vec<_> = planned.iter().map(under_way).collect();
        let mut exact = planned.iter().enumerate().flat_map(|(arc, planned)| {
            let samples = planned.method.samples();
            samples.map(move |(exact, _)| (arc, planned, exact))
        });
        let each = &mut |command: Command| {
            let Some((arc, planned, exact)) = exact.next() else {
                return;
            };
            let point = job.mm(command.counts);
            let [off, _] = planned.circle.off(point);
            arcs[arc].take(point, exact, off);
            if let Some(start) = start
                .as_mut()
                .filter(|start| start.segment == planned.segment)
            {
                start.take(point, off);
            }
        };
        let played = play_each(&circuit, &all, job.sample_ticks, None, &mut (), each)?;
        let finish = |(planned, under_way): (&Planned, UnderWay)| {
            let (radius, rounding) = (planned.circle.radius * per_mm, job.settings.rounding);
            let bound = conventional_error(radius, planned.steps(), &Widths::FULL, rounding);
            Arc {
                segment: planned.segment,
                piece: planned.piece,
                error: under_way.error,
                bound: bound / per_mm,
                radius_error: under_way.radius_error,
                jolt: under_way.jolting.finish(),
            }
        };
        Ok(Beside {
            arcs: planned.iter().zip(arcs).map(finish).collect(),
            samples: samples(&planned),
            played,
            left: None,
            start: start.map_or(Vec::new(), |start| start.curve),
        })
    }

    /// Returns the complaints about the arcs; empty if there are none.
    pub fn complaints(&self, how: &str) -> impl Iterator<Item = String> {
        let (sampled, wanted) = (self.played.samples, self.samples);
        let short = (sampled != wanted)
            .then(|| format!("{sampled} samples {how} where the arcs have {wanted}"));
        let astray = self.arcs.iter().filter(|arc| {
            // Written so that NaN fails.
            let within = arc.error <= arc.bound;
            !within
        });
        let astray = astray.map(move |arc| {
            let (error, bound) = (arc.error * 1e3, arc.bound * 1e3);
            let piece = arc.piece;
            format!(
                "piece {piece} {how}: a sample is {error:.3} um off its exact point, its bound is \
                 {bound:.3} um"
            )
        });
        short.into_iter().chain(astray)
    }

    /// Largest radius error in mm of the arc that is this segment.
    pub fn radius_error(&self, segment: usize) -> f64 {
        let arc = self.arcs.iter().find(|arc| arc.segment == segment);
        arc.map_or(0.0, |arc| arc.radius_error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::source::{Input, Source};
    use motion_rtl::jobs::arc_generator::beside;
    use motion_rtl::scenario::Scenario;

    /// Every arc of the flange against its commands, all at once.
    #[test]
    fn every_arc_is_measured_over_all_of_its_commands() {
        let input = Input {
            input: Some("waves/flange.toml".into()),
            ..Input::default()
        };
        let source = Source::read(&input).unwrap();
        let Scenario::ArcGenerator(scenario) = source.loaded.scenario.clone() else {
            panic!("another circuit");
        };
        let job = Job::prepare(source, scenario.settings).unwrap();
        let (planned, all) = runs(&job, Method::new).unwrap();
        let circuit = Conventional::new(job.settings.rounding);
        let played = beside::play(&circuit, &all, job.sample_ticks, &mut ()).unwrap();
        let measured = Beside::run(&job, Method::new, None).unwrap();
        assert!(measured.arcs.len() > 2 && measured.arcs.len() == planned.len());
        assert_eq!(measured.samples, played.commands.len() as u64);
        let mut commands = played.commands.iter();
        for (arc, planned) in measured.arcs.iter().zip(&planned) {
            let own = commands.by_ref().take(planned.steps() as usize + 1);
            let points: Vec<Point> = own.map(|command| job.mm(command.counts)).collect();
            let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
            let exact = planned.method.samples().map(|(exact, _)| exact);
            let errors = points.iter().zip(exact).map(|(a, b)| distance(*a, b));
            assert_eq!(arc.error, largest(&mut { errors }));
            let off = points
                .iter()
                .map(|point| planned.circle.off(*point)[0].abs());
            assert_eq!(arc.radius_error, largest(&mut { off }));
            assert_eq!(measured.radius_error(arc.segment), arc.radius_error);
        }
    }
}
