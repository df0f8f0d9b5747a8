//! Waves around the first difference.

use super::*;
use std::fs;
use std::path::Path;

/// Times of a VCD: the first and the last, in ticks.
fn ticks_of(path: &Path) -> (u64, u64) {
    let vcd = fs::read_to_string(path).unwrap();
    let times = vcd.lines().filter_map(|line| line.strip_prefix('#'));
    let times: Vec<u64> = times.map(|time| time.parse().unwrap()).collect();
    // A tick has ten units; the last time is the end of the last tick.
    (times[0] / 10, times.last().unwrap() / 10 - 1)
}

#[test]
fn waves_show_the_ticks_around_the_first_difference() {
    // Difference, length of the run, first and last tick of the waves.
    let cases = [
        (450, 800, 350, 549),
        (300, 800, 200, 399),
        (30, 800, 0, 129),
        (0, 800, 0, 99),
        (450, 470, 350, 469),
        (450, 451, 350, 450),
    ];
    for (difference, length, first, last) in cases {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("new/around.vcd");
        let options = Options {
            from_power_on: true,
            waves: Some(path.clone()),
            ..Options::default()
        };
        let mut beside = Beside::new("linear_interpolator", "", &options);
        let mut seed = 1_u64;
        let mut said = String::new();
        for tick in 0..length {
            random_inputs(&mut beside.design, &mut seed);
            let rst = tick % 90 == 70;
            let flip = u64::from(tick == difference) << 40;
            said += &beside.edge_with(rst, |words| words[3] ^= flip);
        }
        let (verdict, report) = beside.end();
        assert_eq!(verdict, Verdict::Fail);
        // The waves leave the model as it was: nothing else differs.
        let head = format!(
            "FAIL: 1 of {} values differ, in 1 of {length} ticks\n",
            9 * length
        );
        assert!(report.contains(&head), "{report}");
        let waves = format!(
            "waves of the model, ticks {first} to {last}: {}\n",
            path.display()
        );
        assert!((said + &report).contains(&waves), "{report}");
        assert_eq!(ticks_of(&path), (first, last));
        same_waves(&path, difference, length, first..last + 1);
    }
}

/// Compares waves with those of an uninterrupted run with the same inputs.
fn same_waves(path: &Path, difference: u64, length: u64, ticks: Range<u64>) {
    let directory = tempfile::tempdir().unwrap();
    let whole = directory.path().join("whole.vcd");
    let mut design = Model::new("linear_interpolator", &[]).unwrap();
    let mut seed = 1;
    for tick in 0..length {
        if tick == ticks.start {
            design.waves_to(&whole).unwrap();
        }
        if tick == ticks.end {
            break;
        }
        random_inputs(&mut design, &mut seed);
        match tick % 90 == 70 {
            true => design.reset(),
            false => design.step(),
        }
    }
    design.finish_waves().unwrap();
    let [own, other] = [path, &whole].map(|path| fs::read_to_string(path).unwrap());
    assert!(own == other, "difference in tick {difference}: other waves");
}

#[test]
fn waves_of_no_format_are_refused_at_once() {
    for path in ["a.txt", "a", "a.VCD"] {
        let options = Options {
            waves: Some(path.into()),
            ..Options::default()
        };
        let error = Checker::new(model("enable_counter", "width=8"), &options).unwrap_err();
        let text = format!("{path}: the extension names no format; allowed: .vcd, .fst");
        assert!(error.to_string().ends_with(&text), "{error}");
    }
}

#[test]
fn waves_that_cannot_be_written_do_not_disturb_the_comparison() {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("file"), "").unwrap();
    let options = Options {
        from_power_on: true,
        waves: Some(directory.path().join("file/a.vcd")),
        ..Options::default()
    };
    let mut beside = Beside::new("enable_counter", "width=8", &options);
    beside.set("period", 3);
    beside.edges(250);
    let text = beside.edge_with(false, |words| words[1] ^= 1);
    assert!(
        text.contains("file/a.vcd: the waves could not be written: "),
        "{text}"
    );
    assert_eq!(text.matches("file/a.vcd").count(), 1, "{text}");
    beside.edges(250);
    let (_, report) = beside.end();
    assert!(
        report.starts_with("FAIL: 1 of 501 values differ, in 1 of 501 ticks\n"),
        "{report}"
    );
}
