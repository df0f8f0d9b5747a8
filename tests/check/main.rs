//! Reachability, lockstep and monitors on circuits whose answers are known by hand.

mod circuits;
mod composite;
mod lockstep;
mod monitor;
mod reach;
mod report;
mod search;
mod sweep;
