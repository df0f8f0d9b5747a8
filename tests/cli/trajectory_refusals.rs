//! Bad settings, machines and moves of the trajectory controller: their errors.

use super::trajectory::{MACHINE, with};

#[test]
fn bad_settings_are_refused_with_their_line() {
    // The head has five lines, the piece two.
    let cases = [
        (
            "",
            "s.toml: piece: missing; allowed: tables [[piece]], or an input: an HPGL drawing or a G-code program",
        ),
        (
            "start_mm = [1, 0, 0]\ninput = \"l.ngc\"\n",
            "s.toml:6: start_mm: is [1.0, 0.0, 0.0] beside an input; allowed: where the drawing begins: no start_mm",
        ),
        (
            "input = \"l.ngc\"\n[[piece]]\nto_mm = [10, 0, 0]\n",
            "s.toml:6: input: given beside tables [[piece]]; allowed: a drawing or pieces, not both",
        ),
        (
            "axes = 5\n[[piece]]\nto_mm = [10, 0, 0]\n",
            "s.toml:6: axes: is 5; allowed: 2, 3 or 4",
        ),
        (
            "axes = 2\n[[piece]]\nto_mm = [10, 0, 1]\n",
            "s.toml:8: piece 0: to_mm: leaves the plane of x and y by 1 mm; allowed: the height of the start, or three axes",
        ),
        (
            "[[piece]]\nto_mm = [10, 0, 0]\n[[piece]]\nvia_mm = [20, 0, 0]\nto_mm = [30, 0, 0]\nfeed_mm_per_min = 180\n",
            "",
        ),
        (
            "[[piece]]\nto_mm = [10, 0, 0]\nfeed_mm_per_min = 0\n",
            "s.toml:8: piece 0: feed_mm_per_min: is 0; allowed: 0.00006 to 60000000000",
        ),
        (
            "[[piece]]\nto_mm = [10, 0, 0]\n[[piece]]\nto_mm = [30, 0, 0]\nvia_mm = [20, 9, 0]\nspline = true\n",
            "s.toml:11: piece 1: spline: given beside via_mm; allowed: an arc or a spline",
        ),
        (
            "[[piece]]\nto_mm = [10, 0, 0]\nspline = true\n[[piece]]\nto_mm = [10, 0, 0]\nspline = true\n",
            "s.toml:10: piece 1: to_mm: start and end are the same point; allowed: points apart",
        ),
        (
            "[[piece]]\nto_mm = [nan, 0, 0]\nspline = true\n",
            "s.toml:7: piece 0: to_mm: is NaN for x; allowed: -1000000000 to 1000000000",
        ),
        (
            "axes = 2\n[[piece]]\nto_mm = [10, 0, 1]\nspline = true\n[[piece]]\nto_mm = [20, 0, 0]\nspline = true\n",
            "s.toml:8: piece 0: to_mm: leaves the plane of x and y by ",
        ),
        (
            "[[piece]]\nto_mm = [10, 0, 0]\nspline = 1\n",
            "s.toml:8: spline: invalid type: integer `1`; allowed: true or false",
        ),
        (
            "k1_per_s = 0\n[[piece]]\nto_mm = [10, 0, 0]\n",
            "s.toml:6: k1_per_s: is 0: ",
        ),
        (
            "k2_per_s = 100\n[[piece]]\nto_mm = [10, 0, 0]\n",
            "s.toml:6: k2_per_s: is 100: ",
        ),
        (
            "correction = \"both\"\n",
            "s.toml:6: correction: unknown variant `both`; allowed: one of `vector`, `none`, `steady`, `feedback`",
        ),
        (
            "normal_gain = 256\n[[piece]]\nto_mm = [10, 0, 0]\n",
            "s.toml:6: normal_gain: is 256; allowed: 0 to 255.99609375",
        ),
        (
            "tangential_gain = -0.1\n[[piece]]\nto_mm = [10, 0, 0]\n",
            "s.toml:6: tangential_gain: is -0.1; allowed: 0 to 255.99609375",
        ),
        (
            "acceleration_mm_per_s2 = nan\n[[piece]]\nto_mm = [10, 0, 0]\n",
            "s.toml:6: acceleration_mm_per_s2: is NaN; allowed: ",
        ),
        (
            "contour_tolerance_mm = 0\n[[piece]]\nto_mm = [10, 0, 0]\n",
            "s.toml:6: contour_tolerance_mm: is 0; allowed: 0.000001 to 1000",
        ),
        (
            "jerk_time_ms = -1\n[[piece]]\nto_mm = [10, 0, 0]\n",
            "s.toml:6: jerk_time_ms: is -1; allowed: 0 to ",
        ),
        (
            "position_gain_per_s = 0\n[[piece]]\nto_mm = [10, 0, 0]\n",
            "s.toml:6: position_gain_per_s: is 0; allowed: ",
        ),
        (
            "speed_hz = 1e6\n[[piece]]\nto_mm = [10, 0, 0]\n",
            "s.toml:6: speed_hz: is 1000000: ",
        ),
        (
            "integral_ms = -1\n[[piece]]\nto_mm = [10, 0, 0]\n",
            "s.toml:6: integral_ms: is -1; allowed: 0 to ",
        ),
        (
            "[[piece]]\nto_mm = [2e6, 0, 0]\n",
            "s.toml:7: piece 0: to_mm: x reaches ",
        ),
        (
            "acceleration_time_ms = 50\nacceleration_mm_per_s2 = 1e3\n[[piece]]\nto_mm = [10, 0, 0]\n",
            "s.toml:6: acceleration_time_ms: is 50 beside acceleration_mm_per_s2; allowed: one of both",
        ),
        (
            "axis_acceleration_mm_per_s2 = [1e3]\n[[piece]]\nto_mm = [10, 0, 0]\n",
            "s.toml:6: axis_acceleration_mm_per_s2: is a list of 1; allowed: a number for all axes, or a list of 2",
        ),
        (
            "k1_per_s = [50, 60]\n[[piece]]\nto_mm = [10, 0, 0]\n",
            "s.toml: k2_per_s: is 200: 0.20001220703125 a period; allowed: ",
        ),
        (
            "k1_per_s = [50, 40, 30]\n[[piece]]\nto_mm = [10, 0, 0]\n",
            "s.toml:6: k1_per_s: is a list of 3; allowed: a number for all axes, or a list of 2",
        ),
        (
            "inertia_factor = [1, 1, 1]\n[[piece]]\nto_mm = [10, 0, 0]\n",
            "s.toml:6: inertia_factor: is a list of 3; allowed: a number for all axes, or a list of 2",
        ),
        (
            "inertia_factor = \"half\"\n[[piece]]\nto_mm = [10, 0, 0]\n",
            "s.toml:6: inertia_factor: invalid type: string \"half\"; allowed: a number for all axes, or a list of one for each",
        ),
        (
            "inertia_factor = [1, -2]\n[[piece]]\nto_mm = [10, 0, 0]\n",
            "s.toml:6: inertia_factor: is -2 for y; allowed: 0 to 100",
        ),
        (
            "[[piece]]\nto_mm = [10, 0, 0]\n[[load_torque]]\naxis = \"z\"\ntorque_nm = 1\n",
            "s.toml:9: load_torque 0: axis: is z; allowed: one of x, y",
        ),
        (
            "[[piece]]\nto_mm = [10, 0, 0]\n[[load_torque]]\naxis = \"v\"\ntorque_nm = 1\n",
            "s.toml:9: axis: unknown variant `v`; allowed: one of `x`, `y`, `z`, `w`",
        ),
        (
            "[[piece]]\nto_mm = [10, 0, 0]\n[[load_torque]]\naxis = \"x\"\ntorque_nm = 1\nfrom_s = 2\nto_s = 1\n",
            "s.toml:12: load_torque 0: to_s: is 1; allowed: above from_s, 2, to 1000000",
        ),
        (
            "load_torque = 3\n[[piece]]\nto_mm = [10, 0, 0]\n",
            "s.toml:6: load_torque: invalid type: integer `3`; allowed: tables [[load_torque]]",
        ),
        (
            "[machine]\nmass = 1\n",
            "s.toml:7: mass: unknown key; allowed: one of `max_torque_nm`, ",
        ),
        (
            "[machine]\nmax_torque_nm = 1\n",
            "s.toml:6: motor_inertia_kg_m2: missing, and has no default; allowed: a number from 0.000000001 to 1000000000",
        ),
    ];
    for (text, refusal) in cases {
        let bench = with(text);
        bench.write("l.ngc", "G1 X20 F600\n");
        let before = bench.names();
        let done = bench.run(&["run", "s.toml", "--no-vcd"]);
        let start = match refusal {
            // The three points on a line.
            "" => "error: s.toml:9: piece 1: via_mm: the point via is only ".to_owned(),
            refusal => format!("error: {refusal}"),
        };
        assert!(done.stderr.starts_with(&start), "{text}: {}", done.stderr);
        assert_eq!((done.code, done.stdout.as_str()), (2, ""), "{text}");
        assert_eq!(bench.names(), before, "{text}");
    }
}

#[test]
fn bad_machines_are_refused_with_their_line() {
    let piece = "[[piece]]\nto_mm = [10, 0, 0]\n";
    let with_machine = |change: (&str, &str)| {
        let machine = MACHINE.replace(change.0, change.1);
        format!("{piece}[machine]\n{machine}")
    };
    // The head has five lines, the piece two, the table begins in the eighth.
    let bench = with(&with_machine(("mm_per_rev = 10", "mm_per_rev = 5")));
    bench.refuse(
        &["run", "s.toml"],
        "s.toml:14: machine.mm_per_rev: is 5, which gives 2000 counts per mm; allowed: 10, for 1000 counts per mm as in \
         counts_per_mm",
    );
    let bench = with(&with_machine(("= 200", "= -1")));
    bench.refuse(
        &["run", "s.toml"],
        "s.toml:12: machine.stiffness_nm_per_rad: is -1; allowed: 0.000000001 to 1000000000",
    );
    // A key of the table by an override.
    bench.refuse(
        &["run", "s.toml", "--set", "machine.stiffness_nm_per_rad=0"],
        "--set: machine.stiffness_nm_per_rad: is 0; allowed: 0.000000001 to 1000000000",
    );
    let run = [
        "run",
        "s.toml",
        "--no-vcd",
        "--set",
        "machine.stiffness_nm_per_rad=300",
    ];
    assert_eq!(bench.json(&run)["exact"], true);
    // One that the clock is too slow for.
    let bench = with(&format!(
        "{piece}[machine]\n{MACHINE}damping_nm_s_per_rad = 1e9\n"
    ));
    bench.refuse(
        &["run", "s.toml"],
        "s.toml:2: clock_hz: is 400000: a tick of 2.5e-6 s; allowed: a faster clock: a tick of at \
         most 6.666666664232344e-9 s",
    );
    let bench = with(&format!("{piece}[[axis]]\n{MACHINE}"));
    bench.refuse(
        &["run", "s.toml"],
        "s.toml: axis: given 1 times; allowed: 2 tables [[axis]], or one table [machine] for all",
    );
    let second = MACHINE.replace("= 2e-3", "= 0");
    let bench = with(&format!("{piece}[[axis]]\n{MACHINE}[[axis]]\n{second}"));
    bench.refuse(
        &["run", "s.toml"],
        "s.toml:18: axis 1: load_inertia_kg_m2: is 0; allowed: 0.000000001 to 1000000000",
    );
}

#[test]
fn bad_moves_are_refused_with_their_line() {
    let cases = [(
        "G1 X20 F600\nG2 X40 Y1 I3\n",
        "p.ngc:2: I, J: the radius is 3.0000 mm at the start and 17.0294 mm at the end; allowed: radii that agree to 0.0283 mm, or to 0.1 % and 2.83 mm",
    )];
    for (text, refusal) in cases {
        let bench = with("input = \"p.ngc\"\n");
        bench.write("p.ngc", text);
        bench.refuse(&["run", "s.toml", "--out", "new"], refusal);
    }
    let bench = with("input = \"p.ngc\"\naxes = 2\n");
    bench.write("p.ngc", "G1 X20 F600\nG2 X40 I10 Z5\n");
    bench.refuse(
        &["run", "s.toml", "--out", "new"],
        "p.ngc:2: Z: leaves the plane of x and y by 5 mm; allowed: the height of the start, or three axes",
    );
    let many: String = (1..=4097)
        .map(|k| format!("G1 X{k} Y{}\n", k % 2))
        .collect();
    let bench = with("input = \"p.ngc\"\n");
    bench.write("p.ngc", format!("G1 F600\n{many}"));
    bench.refuse(
        &["run", "s.toml", "--out", "new"],
        "p.ngc:4098: path: the path has 4097 segments, which take addresses of A = 13 bits; allowed: at most 4096",
    );
    bench.refuse(
        &["table", "waves/corner.toml"],
        "waves/corner.toml:2: circuit: the trajectory controller has no table; allowed: \
         pulse_interpolator, or the command run",
    );
}
