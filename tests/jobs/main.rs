//! Whole jobs: what prepares them, how they are played on the circuits, what is measured of them.

mod arc_job;
mod arc_path;
mod job;
mod lead_job;
mod linear_job;
mod machine_job;
mod machine_measure;
mod table;
mod targets;
mod trajectory_host;
mod trajectory_job;
