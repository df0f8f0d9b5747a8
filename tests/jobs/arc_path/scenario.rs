//! Scenarios of the arc generator: keys, defaults, and faults with their lines.

use motion_rtl::circuits::arc_generator::{Blend, Rounding, Widths};
use motion_rtl::jobs::arc_generator::prepare::prepare;
use motion_rtl::jobs::arc_generator::settings::{Settings, ShortPieces};
use motion_rtl::jobs::taught::taught;
use motion_rtl::path::pieces::{Taught, from_points};
use motion_rtl::scenario::Keys;
use motion_rtl::scenario::{Loaded, Scenario};
use motion_rtl::settings::SettingError;

const HEAD: &str = "circuit = \"arc_generator\"\n";

fn loaded(text: &str) -> Loaded {
    Loaded::parse("s.toml", &format!("{HEAD}{text}"), &[]).unwrap()
}

fn keys(loaded: &Loaded) -> &Keys<Settings> {
    match &loaded.scenario {
        Scenario::ArcGenerator(keys) => keys,
        other => panic!("{other:?}"),
    }
}

fn taught_of(keys: &Keys<Settings>) -> Result<Vec<Taught>, SettingError> {
    taught(keys.run.input.as_ref(), &keys.settings.piece, false)
}

fn refusal(text: &str) -> String {
    let text = format!("{HEAD}{text}");
    Loaded::parse("s.toml", &text, &[]).unwrap_err().to_string()
}

#[test]
fn a_bare_scenario_has_the_default_settings() {
    let loaded = loaded("");
    let keys = keys(&loaded);
    assert_eq!(keys.settings, Settings::default());
    assert_eq!(taught_of(keys), Ok(Vec::new()));
    assert_eq!(loaded.scenario.clock_hz(), 1_000_000);
    assert_eq!(loaded.scenario.vcd_ticks(), 1_000_000);
    assert_eq!(loaded.scenario.input(), None);
}

#[test]
fn every_key_is_read() {
    let loaded = loaded(
        "clock_hz = 2000000\nsample_period_ms = 0.5\nacceleration_ms = 32\ncounts_per_mm = 250\n\
         feed_mm_per_min = 1800\nrapid_mm_per_min = 5400\ncorner_deg = 5\nrounding = \"floor\"\n\
         blend = \"products\"\n\
         short_pieces = \"slower\"\nvcd_ticks = 77\nstart_mm = [1, 2, 3]\n\
         [[piece]]\nto_mm = [4, 5, 6.5]\n\
         [[piece]]\nvia_mm = [7, 8, 9]\nto_mm = [10, 11, 12]\nfeed_mm_per_min = 180\n",
    );
    let keys = keys(&loaded);
    let settings = Settings {
        clock_hz: 2_000_000,
        sample_period_ms: 0.5,
        acceleration_ms: 32.0,
        counts_per_mm: 250.0,
        feed_mm_per_min: Some(1800.0),
        rapid_mm_per_min: 5400.0,
        corner_deg: 5.0,
        rounding: Rounding::Floor,
        blend: Blend::Products,
        short_pieces: ShortPieces::Slower,
        start_mm: [1.0, 2.0, 3.0],
        piece: keys.settings.piece.clone(),
        ..Settings::default()
    };
    assert_eq!(keys.settings, settings);
    assert_eq!(keys.settings.rounding.name(), "floor");
    let taught = [
        Taught {
            to: [4.0, 5.0, 6.5],
            via: None,
            spline: false,
            speed: None,
        },
        Taught {
            to: [10.0, 11.0, 12.0],
            via: Some([7.0, 8.0, 9.0]),
            spline: false,
            speed: Some(3.0),
        },
    ];
    assert_eq!(taught_of(keys), Ok(taught.to_vec()));
    assert_eq!(loaded.scenario.vcd_ticks(), 77);
}

#[test]
fn keys_of_the_wrong_shape_are_refused_with_their_line() {
    assert_eq!(
        refusal("[[piece]]\nvia_mm = [1, 2, 3]\n"),
        "s.toml:2: to_mm: missing, and has no default; allowed: a list of X, Y, Z, or of X, Y, Z, W"
    );
    assert_eq!(
        refusal("[[piece]]\nto_mm = [1, 2]\n"),
        "s.toml:3: to_mm: invalid length 2; allowed: a list of three numbers, of X, Y and Z, or of four with W"
    );
    assert_eq!(
        refusal("start_mm = [1, 2, 3, 4]\n"),
        "s.toml:2: start_mm: invalid length 4; allowed: a list of three numbers, of X, Y and Z"
    );
    assert_eq!(
        refusal("[[piece]]\nto_mm = [1, 2, \"z\"]\n"),
        "s.toml:3: to_mm: invalid type: string \"z\"; allowed: a number from -1000000000 to 1000000000"
    );
    assert_eq!(
        refusal("piece = 3\n"),
        "s.toml:2: piece: invalid type: integer `3`; allowed: tables [[piece]]"
    );
    assert_eq!(
        refusal("rounding = \"up\"\n"),
        "s.toml:2: rounding: unknown variant `up`; allowed: `nearest` or `floor`"
    );
    assert_eq!(
        refusal("[[piece]]\nto_mm = [1, 2, 3]\nspeed = 3\n"),
        "s.toml:4: speed: unknown key; allowed: one of `to_mm`, `via_mm`, `spline`, `feed_mm_per_min`"
    );
    let set = ["start_mm=[1,2]".to_owned()];
    assert_eq!(
        Loaded::parse("s.toml", HEAD, &set).unwrap_err().to_string(),
        "--set: start_mm: invalid length 2; allowed: a list of three numbers, of X, Y and Z"
    );
}

#[test]
fn a_path_is_given_once() {
    let loaded = loaded("\ninput = \"x.ngc\"\n[[piece]]\nto_mm = [1, 2, 3]\n");
    let error = taught_of(keys(&loaded)).unwrap_err();
    let fault = loaded.fault(error.field, error.problem, error.allowed);
    assert_eq!(
        fault.to_string(),
        "s.toml:3: input: given beside tables [[piece]]; allowed: a drawing or pieces, not both"
    );
}

#[test]
fn faults_of_settings_and_pieces_have_their_lines() {
    let loaded = loaded(
        "feed_mm_per_min = 1800\nacceleration_ms = 65\n\n\
         [[piece]]\nto_mm = [50, 0, 0]\n\
         [[piece]]\nto_mm = [70, 0, 0]\nvia_mm = [60, 0, 0]\n\
         [[piece]]\nto_mm = [71, 0, 0]\n",
    );
    let keys = keys(&loaded);
    let mut settings = keys.settings.clone();
    let error = settings.timing(&Widths::FULL).unwrap_err();
    let fault = loaded.fault(error.field, error.problem, error.allowed);
    assert_eq!(
        fault.to_string(),
        "s.toml:3: acceleration_ms: is 65: 65 samples; allowed: an even number of samples: \
         64 or 66"
    );
    settings.acceleration_ms = 64.0;
    let mut taught = taught_of(keys).unwrap();
    let shown = |error: motion_rtl::path::error::PathError| {
        let (reason, table) = (error.reason, ("piece", error.piece));
        let (problem, allowed) = (reason.to_string(), reason.allowed());
        let fault = loaded.table_fault(table, reason.field(), problem, allowed);
        fault.to_string()
    };
    let error = from_points(settings.start_mm, &taught, &settings).unwrap_err();
    assert_eq!(
        shown(error),
        "s.toml:9: piece 1: via_mm: the point via is only 0 mm off the line from start to \
         end, 20 mm long; allowed: a point off the line, or a line: no point via"
    );
    taught[1].via = None;
    let pieces = from_points(settings.start_mm, &taught, &settings).unwrap();
    let timing = settings.timing(&Widths::FULL).unwrap();
    let error = prepare(settings.start_mm, &pieces, &timing).unwrap_err();
    assert_eq!(
        shown(error),
        "s.toml:10: piece 2: feed_mm_per_min: at 1800 mm/min the blends at its ends take more than \
         the piece, 1 mm; allowed: at most 923.076 mm/min, or shorter blends"
    );
}
