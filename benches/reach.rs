//! States a second and bytes a state of proofs by exhaustion.

use divan::counter::ItemsCount;
use motion_rtl::blocks::{MulDiv, QuadratureCounter};
use motion_rtl::check::{Proof, Specified, reach};
use motion_rtl::pulse_interpolator::{UnitLaw, Variant};

fn proof<C: Specified>(circuit: &C) -> Proof {
    let invariants = circuit.invariants();
    let outcome = reach(circuit, &invariants)
        .inputs(|i| circuit.applies(i))
        .assume(|q, i| circuit.assumes(q, i))
        .run()
        .expect("narrow enough");
    outcome.proof().expect("it holds")
}

/// In states a second; transitions are shown once.
fn measure<C: Specified + Sync>(bencher: divan::Bencher<'_, '_>, circuit: &C) {
    let Proof {
        states,
        transitions,
        ..
    } = proof(circuit);
    println!("{}: {states} states, {transitions} transitions", C::NAME);
    bencher
        .counter(ItemsCount::new(states))
        .bench_local(|| proof(circuit));
}

#[divan::bench(sample_count = 5)]
fn unit_law_of_4_bits(bencher: divan::Bencher<'_, '_>) {
    measure(bencher, &UnitLaw::<4>::new(Variant::Safe));
}

#[divan::bench(sample_count = 5)]
fn mul_div_of_3_bits(bencher: divan::Bencher<'_, '_>) {
    measure(bencher, &MulDiv::<2, 3>);
}

#[divan::bench(sample_count = 5)]
fn quadrature_counter_of_4_bits(bencher: divan::Bencher<'_, '_>) {
    measure(bencher, &QuadratureCounter::<4>);
}

fn main() {
    divan::main();
}
