//! The summary for people.

use super::summary::{Phase, Summary};
use std::fmt::Write;

/// A name of the settings as scenarios have it.
fn name(value: impl serde::Serialize) -> String {
    let json = serde_json::to_value(value).unwrap_or_default();
    json.as_str().unwrap_or_default().to_owned()
}

impl Summary {
    /// The summary for people, with every positioning if `all` are wanted.
    pub fn text(&self, all: bool) -> String {
        let mut text = String::new();
        // Writing to a string does not fail.
        let _ = self.write(&mut text, all);
        text
    }

    fn write(&self, text: &mut String, all: bool) -> std::fmt::Result {
        writeln!(
            text,
            "{} on {}: {} positionings, {} ticks, {:.3} s at {} Hz, CK of {} ticks",
            self.scenario,
            self.circuit,
            self.positionings.len(),
            self.ticks,
            self.seconds,
            self.clock_hz,
            self.ck_ticks
        )?;
        writeln!(
            text,
            "history {}, lead on {}, comparing {}, {}\n",
            name(self.history),
            name(self.placement),
            name(self.comparing),
            match self.learn {
                true => format!("learning, sign {}", name(self.sign)),
                false => "not learning".to_owned(),
            }
        )?;
        writeln!(text, "stop error      largest        rms   missed")?;
        for system in &self.systems {
            writeln!(
                text,
                "{:<13} {:>9}  {:>9.1}  {:>7}{}",
                system.name,
                system.error_max_counts,
                system.error_rms_counts,
                system.missed,
                if system.own { "  in the waves" } else { "" },
            )?;
        }
        text.push('\n');
        for phase in &self.phases {
            self.phase(text, phase)?;
        }
        if all {
            self.every_positioning(text)?;
        }
        for warning in &self.warnings {
            writeln!(text, "warning: {warning}")?;
        }
        for file in &self.files {
            writeln!(text, "wrote {file}")?;
        }
        Ok(())
    }

    /// The names of the systems as heads of columns.
    fn heads(&self) -> String {
        let names = self.systems.iter();
        names.fold(String::new(), |mut heads, system| {
            let _ = write!(heads, "  {:>12}", system.name);
            heads
        })
    }

    fn phase(&self, text: &mut String, phase: &Phase) -> std::fmt::Result {
        writeln!(
            text,
            "positionings {} to {}{}: stop error of the last of each step",
            phase.from,
            phase.to.saturating_sub(1),
            match (phase.loaded, phase.from) {
                (true, _) => ", with the other load",
                (false, _) => "",
            }
        )?;
        writeln!(
            text,
            "step   target   speed{}     lead  a code  settled after",
            self.heads()
        )?;
        for step in &phase.steps {
            write!(
                text,
                "{:>4}  {:>7}  {:>6}",
                step.step, step.target, step.speed_counts_per_s
            )?;
            columns(text, &step.last_error_counts)?;
            let settled = match step.settled_after {
                Some(after) => after.to_string(),
                None => "never".to_owned(),
            };
            writeln!(
                text,
                "  {:>4.1} ms  {:>6.1}  {:>13}",
                step.lead_ms, step.code_travel_counts, settled
            )?;
        }
        text.push('\n');
        Ok(())
    }

    fn every_positioning(&self, text: &mut String) -> std::fmt::Result {
        writeln!(text, "positioning  step{}     lead  a code", self.heads())?;
        for row in &self.positionings {
            write!(text, "{:>11}  {:>4}", row.positioning, row.step)?;
            columns(text, &row.error_counts)?;
            writeln!(
                text,
                "  {:>4.1} ms  {:>6.1}",
                row.lead_ms, row.code_travel_counts
            )?;
        }
        text.push('\n');
        Ok(())
    }
}

fn columns(text: &mut String, errors: &[i64]) -> std::fmt::Result {
    errors
        .iter()
        .try_for_each(|error| write!(text, "  {error:>12}"))
}
