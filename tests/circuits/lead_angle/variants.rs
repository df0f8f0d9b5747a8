//! Variants: those that the catalogue's proofs do not take, since those take the default, and the
//! forms of the lead, which are held against the embodiment.

use super::below;
use motion_rtl::check::Random;
use motion_rtl::circuits::lead_angle::{
    Division, Form, Memory, RatioLogic, TimeLead, codes, ratio_logic, time_lead,
};
use motion_rtl::prelude::*;
use motion_rtl::registry::{ProofSearch, Verdict, find};
use motion_rtl::trace::LastTicks;

#[test]
fn every_variant_is_proved() {
    let variants = [
        ("placement", "placement=target"),
        ("placement", "placement=halves"),
        ("comparator", "comparing=equal"),
        ("stop_error", "sign=literal"),
        ("lead_arithmetic", "one=true"),
        ("lead_products", "one=true"),
        ("divided_time", "one=true"),
    ];
    for (name, pair) in variants {
        let entry = find(name).expect("it is in the catalogue");
        let pairs = [pair.parse().expect("a key with a value")];
        let circuit = entry.proof(&pairs).expect("it can be made");
        let verdict = circuit.prove(&ProofSearch::default(), &mut |_| ()).unwrap();
        let proved = matches!(verdict, Verdict::Proved(_));
        assert!(proved, "{name} {pair}: {verdict:?}");
    }
}

/// Programs and the ratio logic divide times alike.
#[test]
fn times_are_divided_as_the_ratio_logic_divides_them() {
    for stages in [3, 15, 199] {
        let mut logic = LastTicks::simulator(&RatioLogic { stages }).unwrap();
        for lead_time in 0..1 << codes::time_width(stages) {
            let seen = logic
                .step_with(&ratio_logic::In { lead_time }, |now| {
                    [now.w.code, now.w.ratio, now.w.tap]
                })
                .unwrap();
            let code = codes::rounded(stages as u64, lead_time);
            assert_eq!([code.time, code.ratio, code.tap], seen, "{lead_time}");
        }
    }
}

/// A form of the lead beside the embodiment, with the same samples and the same Δt.
#[derive(Debug, Clone)]
struct Beside {
    form: TimeLead,
}

signals! { for Beside as c;
    /// Ports in.
    struct In {
        /// CK.
        ck: Bit,
        /// Discards the samples taken so far.
        restart: Bit,
        /// The position.
        position: I(c.form.position),
        /// Δt in CKs.
        lead_time: U(codes::time_width(c.form.stages)),
    }
    /// The circuits inside.
    struct Parts {
        /// Figs 1 and 6, with a shift register.
        embodiment: Part<TimeLead>(
            TimeLead::new(c.form.stages, c.form.position, Memory::ShiftRegister)
        ),
        /// Divides the time data beforehand.
        divider: Part<RatioLogic>(RatioLogic { stages: c.form.stages }),
        /// The other form.
        form: Part<TimeLead>(c.form.clone()),
    }
    /// Outputs of each form.
    struct Net {
        /// Dx(+Δt) of the embodiment.
        predicted: I(c.form.position),
        /// Dx(+Δt) of the form.
        form_predicted: I(c.form.position),
        /// The sample, whether it is new, and whether there is enough of it, are the same.
        same: Bit,
    }
}

impl Circuit for Beside {
    const NAME: &'static str = "beside";
    const ABOUT: &'static str = "a form of the lead beside the embodiment";
    records!(In, Nothing, Net, Parts);

    fn tick(&self, i: In, _: Nothing, p: Parts) -> (Net, Nothing) {
        let lead_time = i.lead_time;
        let divided = p.divider.settle(ratio_logic::In { lead_time }).w;
        let ports = |lead_time: U| time_lead::In {
            ck: i.ck,
            restart: i.restart,
            position: i.position,
            lead_time,
        };
        let data = match self.form.division {
            Division::Logic => lead_time,
            Division::Beforehand => divided.ratio.join(divided.tap),
            Division::One => lead_time.resize(self.form.word()),
        };
        let one = p.embodiment.settle(ports(lead_time)).w;
        let other = p.form.settle(ports(data)).w;
        let net = Net {
            predicted: one.present + one.lead,
            form_predicted: match self.form.form {
                Form::Products => other.lead,
                _ => other.present + other.lead,
            },
            same: one.present.equals(other.present)
                & !(one.fresh ^ other.fresh)
                & !(one.enough ^ other.enough),
        };
        (net, Nothing)
    }
}

/// Every form but the embodiment itself.
fn forms(stages: usize, position: usize) -> Vec<Beside> {
    let mut all = Vec::new();
    for memory in [Memory::ShiftRegister, Memory::Ram] {
        for division in [Division::Logic, Division::Beforehand, Division::One] {
            for form in [Form::Difference, Form::Products, Form::EarlyDifference] {
                let of = TimeLead {
                    memory,
                    division,
                    form,
                    ..TimeLead::new(stages, position, memory)
                };
                let none = (memory, form) == (Memory::Ram, Form::EarlyDifference);
                assert_eq!(of.objection().is_some(), none, "{of:?}");
                let itself = (Memory::ShiftRegister, Division::Logic, Form::Difference);
                if !none && (memory, division, form) != itself {
                    all.push(Beside { form: of });
                }
            }
        }
    }
    assert_eq!(all.len(), 14);
    all
}

/// The longest time that a form can be given.
fn longest(beside: &Beside) -> u64 {
    match beside.form.division {
        Division::One => beside.form.stages as u64,
        _ => codes::largest(beside.form.stages),
    }
}

/// The law of all forms: in every tick, under every input, they predict what the embodiment predicts.
#[test]
#[ignore = "takes long"]
fn every_form_is_proved_to_predict_what_the_embodiment_predicts() {
    for beside in forms(2, 2) {
        let longest = longest(&beside);
        let law = Invariants::<Beside>::new().always("they predict the same", |now| {
            let [one, other] = [now.see(|s| s.w.predicted), now.see(|s| s.w.form_predicted)];
            let right = now.see(|s| s.w.same) && one == other;
            require(right, ["form_predicted"], || format!("{:?}", now.w))
        });
        let given = move |i: &In<Value>| i.lead_time <= longest;
        let outcome = reach(&beside, &law).inputs(given).run().unwrap();
        assert!(
            matches!(outcome, Outcome::Proof(_)),
            "{beside:?}: {outcome}"
        );
    }
}

#[test]
fn at_full_width_too() {
    for beside in forms(199, 24) {
        let mut random = Random::new(3);
        let mut simulator = LastTicks::simulator(&beside).unwrap();
        let mut i = zero(&beside);
        let mut led = 0;
        for tick in 0..3_000 {
            i.ck = below(&mut random, 4) > 0;
            i.restart = tick % 701 == 700;
            i.position = random.word() as i64 >> 40;
            if below(&mut random, 5) == 0 {
                i.lead_time = below(&mut random, longest(&beside) + 1);
            }
            let (same, predicted, form) = simulator
                .step_with(&i, |now| {
                    let leads = now.w.predicted != now.see(|s| s.p.embodiment.w.present);
                    led += usize::from(leads);
                    (now.w.same, now.w.predicted, now.w.form_predicted)
                })
                .unwrap();
            assert!(same && predicted == form, "{beside:?}, tick {tick}");
        }
        assert!(led > 2_000, "{beside:?}: {led}");
    }
}
