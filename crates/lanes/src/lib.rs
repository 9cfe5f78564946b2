//! Vector lanes with equal bits on every instruction set.
