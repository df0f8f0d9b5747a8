use super::*;

fn refusal(text: &str, sets: &[&str]) -> String {
    let sets: Vec<_> = sets.iter().map(|&set| set.to_owned()).collect();
    Loaded::parse("s.toml", text, &sets)
        .unwrap_err()
        .to_string()
}

const BARE: &str = crate::scenario::BARE;

#[test]
fn a_fault_of_a_value_has_its_line_however_much_is_overridden() {
    let text = format!("# first\n\n{BARE}# clock_hz = 1\n\"clock_hz\" = 0\n");
    let sets = ["line_unit_ticks=500", "variant=literal"].map(str::to_owned);
    let loaded = Loaded::parse("s.toml", &text, &sets).unwrap();
    let shown = |key| loaded.fault(key, "is 0".into(), "more".into()).to_string();
    assert_eq!(shown("clock_hz"), "s.toml:5: clock_hz: is 0; allowed: more");
    assert_eq!(
        shown("line_unit_ticks"),
        "--set: line_unit_ticks: is 0; allowed: more"
    );
    assert_eq!(shown("vcd_ticks"), "s.toml: vcd_ticks: is 0; allowed: more");
}

#[test]
fn a_wrong_type_names_the_key_also_lines_below_it() {
    assert_eq!(
        refusal(
            &format!("{BARE}steps_per_mm = [\n  80,\n  \"a\",\n]\n"),
            &[]
        ),
        "s.toml:4: steps_per_mm: invalid type: string \"a\"; allowed: a number from -1000000000 to 1000000000"
    );
}

#[test]
fn a_list_that_is_too_long_is_refused_in_a_file_too() {
    for list in ["[1]", "[1, 2, 3]"] {
        let text = format!("circuit = \"linear_interpolator\"\ncounts_per_mm = {list}\n");
        let given = list.matches(',').count() + 1;
        assert_eq!(
            refusal(&text, &[]),
            format!(
                "s.toml:2: counts_per_mm: invalid length {given}; allowed: a list of two \
                 numbers, of X and of Y"
            )
        );
    }
}

const STEPS: &str = "circuit = \"lead_angle\"\nrest_ms = 0\n[[step]]\ntarget = 1\n\
                     speed_counts_per_s = 10\n\n[[ step ]] # second\nspeed_counts_per_s = 20\n\
                     target = 2\n";

#[test]
fn a_fault_in_a_table_has_its_line() {
    let sets = ["step=[{target=3,speed_counts_per_s=4}]".to_owned()];
    let loaded = Loaded::parse("s.toml", STEPS, &[]).unwrap();
    let shown = |loaded: &Loaded, index, key| {
        let fault = loaded.table_fault(("step", index), key, "is bad".into(), "good".into());
        fault.to_string()
    };
    let text = |line: &str, step: &str| format!("{line}: step {step}: is bad; allowed: good");
    assert_eq!(shown(&loaded, 0, "target"), text("s.toml:4", "0: target"));
    assert_eq!(shown(&loaded, 1, "target"), text("s.toml:9", "1: target"));
    assert_eq!(shown(&loaded, 0, "lead_ms"), text("s.toml:3", "0: lead_ms"));
    assert_eq!(shown(&loaded, 1, "lead_ms"), text("s.toml:7", "1: lead_ms"));
    let loaded = Loaded::parse("s.toml", STEPS, &sets).unwrap();
    assert_eq!(shown(&loaded, 0, "target"), text("--set", "0: target"));
    let inline = "circuit = \"lead_angle\"\nstep = [{target = 3, speed_counts_per_s = 4}]\n";
    let loaded = Loaded::parse("s.toml", inline, &[]).unwrap();
    assert_eq!(shown(&loaded, 0, "target"), text("s.toml:2", "0: target"));
}

#[test]
fn a_fault_in_a_single_table_has_its_line() {
    let machine = "max_torque_nm = 1\nmotor_inertia_kg_m2 = 1\nload_inertia_kg_m2 = 1\n\
                   stiffness_nm_per_rad = 1\ncounts_per_rev = 1\nmm_per_rev = 1\n";
    let head = "circuit = \"trajectory_controller\"\n";
    let text = format!("{head}\n[machine] # all\n{machine}\n[[piece]]\nto_mm = [1, 0, 0]\n");
    let shown = |sets: &[&str], key| {
        let sets: Vec<_> = sets.iter().map(|&set| set.to_owned()).collect();
        let loaded = Loaded::parse("s.toml", &text, &sets).unwrap();
        let fault = loaded.part_fault("machine", key, "is bad".into(), "good".into());
        fault.to_string()
    };
    let at = |line: &str, key: &str| format!("{line}: machine.{key}: is bad; allowed: good");
    assert_eq!(shown(&[], "mm_per_rev"), at("s.toml:9", "mm_per_rev"));
    assert_eq!(shown(&[], "backlash_rad"), at("s.toml:3", "backlash_rad"));
    // One key of the table, and what the others make of it.
    let set = ["machine.mm_per_rev=3"];
    assert_eq!(shown(&set, "mm_per_rev"), at("--set", "mm_per_rev"));
    assert_eq!(
        shown(&set, "max_torque_nm"),
        at("s.toml:4", "max_torque_nm")
    );
    let loaded = Loaded::parse("s.toml", &text, &set.map(str::to_owned)).unwrap();
    let Scenario::TrajectoryController(scenario) = &loaded.scenario else {
        panic!("another circuit");
    };
    assert_eq!(scenario.settings.machine.mm_per_rev, 3.0);
    assert_eq!(scenario.settings.machine.max_torque_nm, 1.0);
    assert!(refusal(&text, &["machine.mass=3"]).starts_with("--set: machine.mass: unknown"));
    // Without the table in the file, the default is at fault.
    let loaded = Loaded::parse("s.toml", head, &[]).unwrap();
    let fault = loaded.part_fault("machine", "mm_per_rev", "is bad".into(), "good".into());
    assert_eq!(fault.to_string(), at("s.toml", "mm_per_rev"));
}

#[test]
fn a_step_of_the_wrong_shape_is_refused_with_its_line() {
    let with = |steps: &str| refusal(&format!("circuit = \"lead_angle\"\n{steps}"), &[]);
    assert_eq!(
        with(""),
        "s.toml: step: missing, and has no default; allowed: tables [[step]]"
    );
    assert_eq!(
        with("step = 5\n"),
        "s.toml:2: step: invalid type: integer `5`; allowed: tables [[step]]"
    );
    assert_eq!(
        with("[[step]]\ntarget = 1\n"),
        "s.toml:2: speed_counts_per_s: missing, and has no default; allowed: a whole number from 10 to 655350"
    );
    assert_eq!(
        with("[[step]]\nspeed_counts_per_s = 1\ntarget = 1.5\n"),
        "s.toml:4: target: invalid type: floating point `1.5`; allowed: a whole number from -2097152 to 2097152"
    );
    assert_eq!(
        with("[[step]]\nspeed = 1\n"),
        "s.toml:3: speed: unknown key; did you mean speed_counts_per_s?; allowed: one of `target`, \
         `speed_counts_per_s`, `lead_ms`, `load_lead_ms`"
    );
    assert_eq!(
        with("sign = \"both\"\n[[step]]\n"),
        "s.toml:2: sign: unknown variant `both`; allowed: `converging` or `literal`"
    );
}

#[test]
fn a_fault_within_the_value_of_an_override_names_its_place() {
    let speed = "speed_counts_per_s=4";
    assert_eq!(
        refusal(STEPS, &["step=[{target=1}]"]),
        "--set: step 0: speed_counts_per_s: missing, and has no default; allowed: a whole number from 10 to 655350"
    );
    assert_eq!(
        refusal(
            STEPS,
            &[&format!(
                "step=[{{target=1,{speed}}},{{target=1.5,{speed}}}]"
            )]
        ),
        "--set: step 1: target: invalid type: floating point `1.5`; allowed: a whole number from -2097152 to 2097152"
    );
    assert_eq!(
        refusal(STEPS, &["step=5"]),
        "--set: step: invalid type: integer `5`; allowed: tables [[step]]"
    );
    assert_eq!(
        refusal("circuit = \"machine\"\n", &["machine=5"]),
        "--set: machine: invalid type: integer `5`; allowed: a table of keys and values"
    );
    let unknown = refusal("circuit = \"machine\"\n", &["machine.mass=5"]);
    assert!(
        unknown.starts_with("--set: machine.mass: unknown key; allowed: one of `max_torque_nm`, "),
        "{unknown}"
    );
    assert_eq!(
        refusal("circuit = \"machine\"\nclock_hz = 9\n", &["clock_hz.b=5"]),
        "--set: clock_hz.b: clock_hz has no keys inside; allowed: a value of it: clock_hz=value"
    );
    let one = refusal("circuit = \"machine\"\n", &["machine={max_torque_nm=1}"]);
    assert!(
        one.starts_with("--set: machine.") && one.contains(": missing, and has no default; "),
        "{one}"
    );
    let step = &format!("step=[{{target=1,{speed}}}]");
    assert_eq!(
        refusal(STEPS, &[step, "step.target=5"]),
        "--set: step.target: step is a list; allowed: the whole list: step=[{key=value,…},…]"
    );
}

#[test]
fn an_override_holds_one_value() {
    let set = "clock_hz=1\nline_unit_ticks=2";
    assert!(refusal(BARE, &[set]).starts_with("--set: clock_hz: invalid type: string"));
}

/// Returns the least scenario of a circuit.
fn least(circuit: Runnable) -> String {
    let steps = match circuit {
        Runnable::LeadAngle => "step = [{target = 1, speed_counts_per_s = 10, lead_ms = 5}]\n",
        _ => "",
    };
    format!("circuit = \"{}\"\n{steps}", circuit.name())
}

#[test]
fn defaults_can_be_given() {
    for circuit in Runnable::ALL {
        let text = least(circuit);
        let without = Loaded::parse("s.toml", &text, &[]).unwrap().scenario;
        let (keys, defaults) = circuit.keys();
        let given = keys.iter().filter(|key| !key.required);
        let given = given.filter_map(|key| Some((key.name, defaults.0.get(key.name)?)));
        let given: Vec<_> = given.collect();
        assert!(given.len() > 10, "{circuit:?}: {}", given.len());
        for (key, value) in given {
            let set = format!("{key}={value}");
            let loaded = Loaded::parse("s.toml", &text, &[set]);
            let loaded = loaded.unwrap_or_else(|fault| panic!("{circuit:?}: {fault}"));
            assert_eq!(loaded.scenario, without, "{circuit:?}: {key} = {value}");
        }
    }
}

#[test]
fn a_key_of_another_unit_names_the_key_and_the_factor() {
    let cases = [
        ("speed_mm_per_s", "feed_mm_per_min"),
        ("feed_mm_per_s", "feed_mm_per_min"),
        ("rapid_mm_per_s", "rapid_mm_per_min"),
    ];
    for circuit in ["arc_generator", "trajectory_controller", "machine"] {
        for (key, name) in cases {
            let text = format!("circuit = \"{circuit}\"\n{key} = 5\n");
            assert_eq!(
                refusal(&text, &[]),
                format!(
                    "s.toml:2: {key}: the key is called {name}, in mm/min: 60 times the number; allowed: {name}"
                )
            );
        }
    }
    // The arc generator has no such speed.
    let corner = |circuit: &str| {
        refusal(
            &format!("circuit = \"{circuit}\"\ncorner_mm_per_s = 5\n"),
            &[],
        )
    };
    let trajectory = corner("trajectory_controller");
    assert!(
        trajectory.contains("is called corner_mm_per_min, in mm/min: 60 times"),
        "{trajectory}"
    );
    let arcs = corner("arc_generator");
    assert!(
        arcs.contains("corner_mm_per_s: unknown key; allowed: "),
        "{arcs}"
    );
    let piece = "circuit = \"arc_generator\"\n[[piece]]\nto_mm = [1, 0, 0]\nspeed_mm_per_s = 2\n";
    assert_eq!(
        refusal(piece, &[]),
        "s.toml:4: speed_mm_per_s: the key is called feed_mm_per_min, in mm/min: 60 times the number; allowed: \
         feed_mm_per_min"
    );
}

#[test]
fn another_circuit_takes_its_keys_from_the_overrides() {
    let sets = [
        "clock_hz=7",
        "step=[{target=3,speed_counts_per_s=20}]",
        "circuit=lead_angle",
    ];
    let sets = sets.map(str::to_owned);
    let loaded = Loaded::parse("s.toml", "circuit = \"machine\"\nck_ticks = 50\n", &sets).unwrap();
    let Scenario::LeadAngle(keys) = &loaded.scenario else {
        panic!("another circuit");
    };
    assert_eq!((keys.settings.clock_hz, keys.settings.ck_ticks), (7, 50));
    assert_eq!(keys.settings.steps[0].target, 3);
    let without = refusal("circuit = \"machine\"\n", &["circuit=lead_angle"]);
    assert!(
        without.starts_with("--set: step: missing, and has no default; "),
        "{without}"
    );
    let wrong = refusal(
        "circuit = \"machine\"\n",
        &["clock_hz=fast", "circuit=arc_generator"],
    );
    assert!(
        wrong.starts_with("--set: clock_hz: invalid type: string"),
        "{wrong}"
    );
}

#[test]
fn keys_that_do_not_apply_are_told_all_at_once() {
    let text = "circuit = \"machine\"\nbeside = true\nrest_ms = 5\nck_tiks = 5\nclock_hz = 9\n";
    let mut faults = Vec::new();
    let mut fault = Loaded::parse("s.toml", text, &[]).err().map(Box::new);
    while let Some(mut one) = fault {
        fault = one.next.take();
        faults.push((one.line, one.field.clone(), one.problem.clone()));
    }
    let expected = [
        (
            2,
            "beside",
            "is not a key of machine, but of pulse_interpolator, linear_interpolator, lead_angle, \
             arc_generator and trajectory_controller",
        ),
        (3, "rest_ms", "is not a key of machine, but of lead_angle"),
        (4, "ck_tiks", "unknown key; did you mean ck_ticks?"),
    ];
    assert_eq!(
        faults,
        expected.map(|(line, key, problem)| (line, key.into(), problem.into()))
    );
}

/// The settings of the machine's scenario, with overrides.
fn machine(text: &str, sets: &[&str]) -> crate::jobs::machine::Settings {
    let sets: Vec<_> = sets.iter().map(|&set| set.to_owned()).collect();
    let loaded = Loaded::parse("s.toml", text, &sets).expect("a scenario");
    match loaded.scenario {
        Scenario::Machine(keys) => keys.settings,
        _ => panic!("another circuit"),
    }
}

#[test]
fn a_key_of_a_table_that_is_not_given_leaves_the_others_at_their_defaults() {
    let text = "circuit = \"machine\"\n";
    let set = machine(text, &["lift.friction_nm=0.5", "machine.backlash_rad=0.25"]);
    let plain = machine(text, &[]);
    assert_eq!(
        (set.lift.friction_nm, set.machine.backlash_rad),
        (0.5, 0.25)
    );
    assert_eq!(set.lift.brake_torque_nm, plain.lift.brake_torque_nm);
    assert_eq!(set.machine.max_torque_nm, plain.machine.max_torque_nm);
    let loaded = Loaded::parse("s.toml", text, &["program.g54_mm=[1,2,3]".to_owned()]);
    let zeros = loaded.expect("a scenario").scenario.run().program.clone();
    assert_eq!((zeros.g54_mm, zeros.g55_mm), ([1.0, 2.0, 3.0], [0.0; 3]));
    // A table without defaults says which of its keys is missing.
    let motor = refusal(BARE, &["motor.friction_nm=1"]);
    assert!(
        motor.starts_with("--set: motor.holding_torque_nm: missing, and has no default"),
        "{motor}"
    );
}

#[test]
fn an_unknown_key_is_named_however_deep_it_is() {
    for (set, key) in [
        ("a.b.c.d=3", "a"),
        ("program.b.c=3", "program.b"),
        ("lift.mass.x=3", "lift.mass"),
    ] {
        let said = refusal("circuit = \"machine\"\n", &[set]);
        assert!(
            said.starts_with(&format!("--set: {key}: unknown key; ")),
            "{set}: {said}"
        );
    }
    let inside = refusal("circuit = \"machine\"\nclock_hz = 5\n", &["clock_hz.x=3"]);
    assert_eq!(
        inside,
        "--set: clock_hz.x: clock_hz has no keys inside; allowed: a value of it: clock_hz=value"
    );
}

#[test]
fn the_name_that_was_meant_and_the_range_of_a_key_are_said() {
    let said = |set: &str| {
        refusal(
            "circuit = \"lead_angle\"\n[[step]]\ntarget = 1\nspeed_counts_per_s = 10\n",
            &[set],
        )
    };
    for (set, start) in [
        (
            "detector=resolvr",
            "--set: detector: unknown variant `resolvr`; did you mean resolver?; allowed: ",
        ),
        (
            "circuit=arc_generatr",
            "--set: circuit: unknown variant `arc_generatr`; did you mean arc_generator?; allowed: ",
        ),
        (
            "clock_hz=-4",
            "--set: clock_hz: is -4; allowed: a whole number from 1 to 10000000000",
        ),
        (
            "circuit=5",
            "--set: circuit: is not text; allowed: one of `pulse_interpolator`, ",
        ),
    ] {
        assert!(said(set).starts_with(start), "{set}: {}", said(set));
    }
    // Of several circuits each has to be one, in whatever order.
    for sets in [
        ["circuit=lead_angle", "circuit=machin"],
        ["circuit=machin", "circuit=lead_angle"],
    ] {
        let said = refusal("circuit = \"arc_generator\"\nblend = \"products\"\n", &sets);
        let start = "--set: circuit: unknown variant `machin`; did you mean machine?; allowed: ";
        assert!(said.starts_with(start), "{said}");
    }
    assert!(
        refusal("circuit = 5\n", &[])
            .starts_with("s.toml:1: circuit: is not text; allowed: one of ")
    );
}
