//! Blocks that more than one circuit is made of.
