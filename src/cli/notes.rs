//! Notes that ship with the program: those with timing charts, and the overviews of their folders.

macro_rules! notes {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../../", $name)))),*]
    };
}

/// Notes by path: name and text. The program for browsers has none, to be small: its page hands it
/// the notes as files.
pub const NOTES: &[(&str, &str)] = match cfg!(target_family = "wasm") {
    true => &[],
    false => ALL,
};

const ALL: &[(&str, &str)] = notes![
    "rtl_notes/arc_generator/README.md",
    "rtl_notes/arc_generator/angle_step.md",
    "rtl_notes/arc_generator/arc_generator.md",
    "rtl_notes/arc_generator/axis_terms.md",
    "rtl_notes/arc_generator/blend_point.md",
    "rtl_notes/arc_generator/blend_row.md",
    "rtl_notes/arc_generator/blend_weight.md",
    "rtl_notes/arc_generator/conventional_generator.md",
    "rtl_notes/arc_generator/matrix_element.md",
    "rtl_notes/arc_generator/position_command.md",
    "rtl_notes/arc_generator/rotation.md",
    "rtl_notes/arc_generator/rotation_row.md",
    "rtl_notes/arc_generator/sine_words.md",
    "rtl_notes/arc_generator/vector_row.md",
    "rtl_notes/blocks/README.md",
    "rtl_notes/blocks/coefficient_control.md",
    "rtl_notes/blocks/cordic.md",
    "rtl_notes/blocks/cordic_state.md",
    "rtl_notes/blocks/difference_column.md",
    "rtl_notes/blocks/difference_engine.md",
    "rtl_notes/blocks/enable_counter.md",
    "rtl_notes/blocks/mul_div.md",
    "rtl_notes/blocks/quadrature_counter.md",
    "rtl_notes/blocks/record_memory.md",
    "rtl_notes/blocks/record_sequencer.md",
    "rtl_notes/blocks/scaler.md",
    "rtl_notes/blocks/shifter.md",
    "rtl_notes/conventions/README.md",
    "rtl_notes/conventions/add_a_circuit.md",
    "rtl_notes/conventions/charts.md",
    "rtl_notes/conventions/memories.md",
    "rtl_notes/golden_model.md",
    "rtl_notes/lead_angle/README.md",
    "rtl_notes/lead_angle/absolute_detector.md",
    "rtl_notes/lead_angle/comparator.md",
    "rtl_notes/lead_angle/compensator.md",
    "rtl_notes/lead_angle/completion_detector.md",
    "rtl_notes/lead_angle/conventional_compensator.md",
    "rtl_notes/lead_angle/correction.md",
    "rtl_notes/lead_angle/correction_arithmetic.md",
    "rtl_notes/lead_angle/difference_history.md",
    "rtl_notes/lead_angle/divided_time.md",
    "rtl_notes/lead_angle/exact_correction.md",
    "rtl_notes/lead_angle/exact_relation.md",
    "rtl_notes/lead_angle/gray_receiver.md",
    "rtl_notes/lead_angle/lead_arithmetic.md",
    "rtl_notes/lead_angle/lead_products.md",
    "rtl_notes/lead_angle/phase_counter.md",
    "rtl_notes/lead_angle/phase_detector.md",
    "rtl_notes/lead_angle/placement.md",
    "rtl_notes/lead_angle/position_history.md",
    "rtl_notes/lead_angle/ram_compensator.md",
    "rtl_notes/lead_angle/ram_history.md",
    "rtl_notes/lead_angle/ram_time_lead.md",
    "rtl_notes/lead_angle/ratio_logic.md",
    "rtl_notes/lead_angle/refinement.md",
    "rtl_notes/lead_angle/resolver_detector.md",
    "rtl_notes/lead_angle/second_order_correction.md",
    "rtl_notes/lead_angle/speed_detector.md",
    "rtl_notes/lead_angle/speed_lead.md",
    "rtl_notes/lead_angle/step_sequencer.md",
    "rtl_notes/lead_angle/stop_error.md",
    "rtl_notes/lead_angle/table_lead.md",
    "rtl_notes/lead_angle/target_setter.md",
    "rtl_notes/lead_angle/time_data.md",
    "rtl_notes/lead_angle/time_lead.md",
    "rtl_notes/lead_angle/time_limit.md",
    "rtl_notes/lead_angle/touch_probe.md",
    "rtl_notes/lead_angle/tracking_converter.md",
    "rtl_notes/lead_angle/tracking_loop.md",
    "rtl_notes/lead_angle/unwrapper.md",
    "rtl_notes/linear_interpolator/README.md",
    "rtl_notes/linear_interpolator/accumulator.md",
    "rtl_notes/linear_interpolator/axis_switch.md",
    "rtl_notes/linear_interpolator/controller.md",
    "rtl_notes/linear_interpolator/conventional_controller.md",
    "rtl_notes/linear_interpolator/conventional_interpolator.md",
    "rtl_notes/linear_interpolator/cycle_gate.md",
    "rtl_notes/linear_interpolator/differentiator.md",
    "rtl_notes/linear_interpolator/integrator.md",
    "rtl_notes/linear_interpolator/line_law.md",
    "rtl_notes/linear_interpolator/linear_interpolator.md",
    "rtl_notes/linear_interpolator/pattern_generator.md",
    "rtl_notes/linear_interpolator/position_control.md",
    "rtl_notes/linear_interpolator/position_loop.md",
    "rtl_notes/linear_interpolator/sequencer.md",
    "rtl_notes/linear_interpolator/target_data.md",
    "rtl_notes/linear_interpolator/trapezoid.md",
    "rtl_notes/machine/README.md",
    "rtl_notes/machine/command_join.md",
    "rtl_notes/machine/enables.md",
    "rtl_notes/machine/machine.md",
    "rtl_notes/pulse_interpolator/README.md",
    "rtl_notes/pulse_interpolator/address_sequencer.md",
    "rtl_notes/pulse_interpolator/axis.md",
    "rtl_notes/pulse_interpolator/command_port.md",
    "rtl_notes/pulse_interpolator/control_computer.md",
    "rtl_notes/pulse_interpolator/conventional_pulse_interpolator.md",
    "rtl_notes/pulse_interpolator/motor_controller.md",
    "rtl_notes/pulse_interpolator/pattern_memory.md",
    "rtl_notes/pulse_interpolator/pulse_generator.md",
    "rtl_notes/pulse_interpolator/pulse_interpolator.md",
    "rtl_notes/pulse_interpolator/pulse_interpolator_groups.md",
    "rtl_notes/pulse_interpolator/pulse_train.md",
    "rtl_notes/pulse_interpolator/sync_stage.md",
    "rtl_notes/pulse_interpolator/unit_law.md",
    "rtl_notes/pulse_interpolator/unit_time.md",
    "rtl_notes/trajectory_controller/README.md",
    "rtl_notes/trajectory_controller/arc_angle.md",
    "rtl_notes/trajectory_controller/axis_row.md",
    "rtl_notes/trajectory_controller/controlled_axis.md",
    "rtl_notes/trajectory_controller/error_feedback.md",
    "rtl_notes/trajectory_controller/length_clamp.md",
    "rtl_notes/trajectory_controller/length_powers.md",
    "rtl_notes/trajectory_controller/model_state.md",
    "rtl_notes/trajectory_controller/path_length.md",
    "rtl_notes/trajectory_controller/path_point.md",
    "rtl_notes/trajectory_controller/period_join.md",
    "rtl_notes/trajectory_controller/point_sequencer.md",
    "rtl_notes/trajectory_controller/reference_model.md",
    "rtl_notes/trajectory_controller/segment_search.md",
    "rtl_notes/trajectory_controller/segment_store.md",
    "rtl_notes/trajectory_controller/servo.md",
    "rtl_notes/trajectory_controller/servo_arithmetic.md",
    "rtl_notes/trajectory_controller/trajectory_controller.md",
    "rtl_notes/trajectory_controller/vector_correction.md",
];

#[cfg(test)]
mod tests {
    use super::NOTES;
    use std::collections::BTreeSet;
    use std::fs;
    use std::path::Path;

    /// Adds the notes of a folder that have charts, and its overview if there are any.
    fn add(folder: &str, names: &mut BTreeSet<String>) {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
        for entry in fs::read_dir(&path).unwrap() {
            let entry = entry.unwrap();
            let name = format!("{folder}/{}", entry.file_name().to_str().unwrap());
            if entry.file_type().unwrap().is_dir() {
                add(&name, names);
            } else if name.ends_with(".md")
                && fs::read_to_string(entry.path())
                    .unwrap()
                    .contains("```chart ")
            {
                names.insert(name);
                // The index of all notes is for readers of the repository.
                if folder != "rtl_notes" {
                    names.insert(format!("{folder}/README.md"));
                }
            }
        }
    }

    #[test]
    fn every_note_with_charts_ships() {
        let mut names = BTreeSet::new();
        add("rtl_notes", &mut names);
        let shipped: Vec<_> = NOTES.iter().map(|(name, _)| *name).collect();
        assert_eq!(shipped, names.iter().collect::<Vec<_>>());
    }
}
