//! Leads from a memory, at full width.

use super::below;
use motion_rtl::check::Random;
use motion_rtl::circuits::lead_angle::{LeadTable, SpeedLead, TableLead, speed_lead, table_lead};
use motion_rtl::trace::LastTicks;

fn filled(lead: impl Fn(i64) -> i64) -> TableLead {
    TableLead {
        position: 24,
        gate: 16,
        table: LeadTable::new(8, 24, 5, lead),
    }
}

/// The lead of each of these ways of a gate of one CK, one after the other.
fn leads(circuit: &TableLead, ways: &[i64]) -> Vec<i64> {
    let mut simulator = LastTicks::simulator(circuit).unwrap();
    simulator.set(|i| i.ck, true).unwrap();
    simulator.step();
    let mut position = 0;
    let lead = |way: &i64| {
        position = (position + way + (1 << 23)).rem_euclid(1 << 24) - (1 << 23);
        simulator.set(|i| i.position, position).unwrap();
        simulator.step();
        assert_eq!(simulator.see(|s| s.w.speed), *way);
        simulator.see(|s| s.w.lead)
    };
    ways.iter().map(lead).collect()
}

/// A memory of a product beside the product: the same in every tick.
#[test]
fn a_memory_of_a_product_gives_what_the_product_gives() {
    let table = filled(|speed| 3 * speed);
    let product = SpeedLead {
        position: 24,
        gate: 16,
    };
    let mut table = LastTicks::simulator(&table).unwrap();
    let mut product = LastTicks::simulator(&product).unwrap();
    let mut random = Random::new(7);
    let (mut position, mut enough, mut led) = (0, 0, 0);
    for tick in 0..20_000 {
        let ck = below(&mut random, 3) > 0;
        let restart = below(&mut random, 50) == 0;
        let gate = 1 + below(&mut random, 4);
        position += below(&mut random, 1001) as i64 - 480;
        let i = table_lead::In {
            ck,
            restart,
            position,
            gate,
        };
        let one = table
            .step_with(&i, |now| {
                (now.w.present, now.w.lead, now.w.fresh, now.w.enough)
            })
            .unwrap();
        let i = speed_lead::In {
            ck,
            restart,
            position,
            lead_parameter: 3 * 256,
            gate,
        };
        let other = product
            .step_with(&i, |now| {
                (now.w.present, now.w.lead, now.w.fresh, now.w.enough)
            })
            .unwrap();
        assert_eq!(one, other, "tick {tick}");
        enough += usize::from(one.3);
        led += usize::from(one.1 != 0);
    }
    assert!(enough > 10_000 && led > 15_000, "{enough}, {led}");
}

/// Checks every speed that the memory covers, and beyond: exact at the words, on a line between
/// them, and off by no more than the curvature of the function allows.
#[test]
fn between_words_the_lead_is_on_a_line() {
    // Another function in either direction: f'' is 1/20 upwards, 1/50 downwards.
    let exact = |speed: i64| match speed >= 0 {
        true => 5 * speed + speed * speed / 40,
        false => 3 * speed - speed * speed / 100,
    };
    let circuit = filled(exact);
    let ways: Vec<i64> = (-4_200..4_200).collect();
    for (way, lead) in ways.iter().zip(leads(&circuit, &ways)) {
        let held = (*way).clamp(-4096, 4095);
        if held % 32 == 0 {
            assert_eq!(lead, exact(held), "{way}");
        }
        // 32² / 8 of f'', and the roundings of the words and of the lead.
        let bent = if held < 0 { 2.56 } else { 6.4 };
        let off = (lead - exact(held)) as f64;
        assert!(off.abs() < bent + 2.0, "{way}: {off}");
    }
}
