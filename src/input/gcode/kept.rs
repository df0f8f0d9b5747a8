//! Parameters maintained by the machine: its position and modal state.

use super::machine::Machine;
use super::modal::{Motion, Plane};
use crate::input::Point;

impl Machine<'_> {
    /// Returns the value of a numbered parameter that the machine maintains, in the current units.
    pub(super) fn parameter(&self, number: u32) -> Option<f64> {
        let units = self.modal.mm_per_unit;
        let axis = |base: u32| (number - base) as usize;
        let pick = |point: Point, base: u32| point.get(axis(base)).map_or(0.0, |mm| mm / units);
        match number {
            5161..=5169 => Some(pick(self.offsets.reference(0), 5161)),
            5181..=5189 => Some(pick(self.offsets.reference(1), 5181)),
            5211..=5219 => Some(pick(self.offsets.shift(), 5211)),
            5220 => Some((self.modal.system + 1) as f64),
            5221..=5389 => {
                let (system, axis) = ((number - 5221) / 20, (number - 5221) % 20);
                if axis == 9 {
                    return Some(self.offsets.rotation(system as usize));
                }
                let offset = self.offsets.system(system as usize);
                Some(offset.get(axis as usize).map_or(0.0, |mm| mm / units))
            }
            5400 => Some(self.tool),
            5401..=5409 => Some(pick(self.modal.tool, 5401)),
            5428 => Some(self.w() / units),
            5420..=5427 => Some(pick(self.here(), 5420)),
            _ => None,
        }
    }

    /// Returns the value of a named parameter that the machine maintains.
    pub(super) fn named(&self, name: &str) -> Option<f64> {
        let units = self.modal.mm_per_unit;
        let flag = |holds: bool| Some(f64::from(u8::from(holds)));
        let metric = self.modal.mm_per_unit == 1.0;
        let [x, y, z] = self.here().map(|mm| mm / units);
        let [machine_x, machine_y, machine_z] = self.turned(self.at).map(|mm| mm / units);
        match name {
            "_X" => Some(x),
            "_Y" => Some(y),
            "_Z" => Some(z),
            "_A" | "_B" | "_C" | "_U" | "_V" | "_TASK" => Some(0.0),
            "_W" => Some(self.w() / units),
            "_ABS_X" => Some(machine_x),
            "_ABS_Y" => Some(machine_y),
            "_ABS_Z" => Some(machine_z),
            "_METRIC" => flag(metric),
            "_IMPERIAL" => flag(!metric),
            "_ABSOLUTE" => flag(!self.modal.relative),
            "_INCREMENTAL" => flag(self.modal.relative),
            "_INVERSE_TIME" => flag(self.modal.inverse_time),
            "_UNITS_PER_MINUTE" => flag(!self.modal.inverse_time),
            "_COORD_SYSTEM" => Some(match self.modal.system {
                system @ 0..=5 => (540 + 10 * system) as f64,
                system => (590 + system - 5) as f64,
            }),
            "_PLANE" => Some(match self.modal.plane {
                Plane::Xy => 170.0,
                Plane::Zx => 180.0,
                Plane::Yz => 190.0,
            }),
            "_MOTION_MODE" => Some(match self.modal.motion {
                None => 800.0,
                Some(Motion::Rapid) => 0.0,
                Some(Motion::Line) => 10.0,
                Some(Motion::Arc { clockwise: true }) => 20.0,
                Some(Motion::Arc { clockwise: false }) => 30.0,
                Some(Motion::Cubic) => 50.0,
                Some(Motion::Quadratic) => 51.0,
                Some(Motion::Nurbs) => 52.0,
                Some(Motion::NurbsEnd) => 53.0,
                Some(Motion::KnottedNurbs) => 62.0,
                Some(Motion::Probe) => 382.0,
                Some(Motion::Cycle(code)) => f64::from(code) * 10.0,
            }),
            "_CCOMP" => Some(400.0),
            "_FEED" => Some(self.feed_word.unwrap_or(0.0)),
            "_RPM" => Some(self.spindle),
            "_CURRENT_TOOL" | "_SELECTED_TOOL" => Some(self.tool),
            "_RETRACT_OLD_Z" => flag(!self.modal.ends_at_r),
            "_RETRACT_R_PLANE" => flag(self.modal.ends_at_r),
            "_VMAJOR" => Some(2.9),
            "_VMINOR" => Some(0.0),
            _ => None,
        }
    }
}
