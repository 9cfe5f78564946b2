//! History of a point: how laws keep numbers and tensors between steps.

use crate::tensor::{SymmetricTensor, Turn};
use embate_lanes::{Batch, Lane};
use std::marker::PhantomData;

/// History values of a point.
pub trait State<L: Lane>: Copy {
    /// How many.
    const COUNT: usize;
    /// All zero; an orientation not turned.
    fn zero() -> Self;
    /// Reads it from the batches `from[0..COUNT]`, lanes from `at` on.
    fn load(from: &[Batch], at: usize) -> Self;
    /// Writes it to the batches `to[0..COUNT]`, lanes from `at` on.
    fn store(self, to: &mut [Batch], at: usize);
}

impl<L: Lane, const S: usize> State<L> for [L; S] {
    const COUNT: usize = S;
    #[inline(always)]
    fn zero() -> Self {
        [L::splat(0.0); S]
    }
    #[inline(always)]
    fn load(from: &[Batch], at: usize) -> Self {
        let mut state = [L::splat(0.0); S];
        for index in 0..S {
            state[index] = L::load(&from[index], at);
        }
        state
    }
    #[inline(always)]
    fn store(self, to: &mut [Batch], at: usize) {
        for index in 0..S {
            self[index].store(&mut to[index], at);
        }
    }
}

/// `N` tensors as history. A rate law turns them with the material itself, by
/// [`super::Kinematics::rotation`].
#[derive(Clone, Copy, Debug)]
pub struct Tensors<L: Lane, T: SymmetricTensor<L>, const N: usize>(pub [T; N], PhantomData<L>);

impl<L: Lane, T: SymmetricTensor<L>, const N: usize> Tensors<L, T, N> {
    /// From the tensors.
    #[inline(always)]
    pub fn new(tensors: [T; N]) -> Self {
        Self(tensors, PhantomData)
    }
}

impl<L: Lane, T: SymmetricTensor<L>, const N: usize> State<L> for Tensors<L, T, N> {
    const COUNT: usize = N * T::COMPONENTS;
    #[inline(always)]
    fn zero() -> Self {
        Self::new([T::isotropic(L::splat(0.0)); N])
    }
    #[inline(always)]
    fn load(from: &[Batch], at: usize) -> Self {
        let mut tensors = [T::isotropic(L::splat(0.0)); N];
        for index in 0..N {
            tensors[index] = T::load(&from[index * T::COMPONENTS..], at);
        }
        Self::new(tensors)
    }
    #[inline(always)]
    fn store(self, to: &mut [Batch], at: usize) {
        for index in 0..N {
            self.0[index].store(&mut to[index * T::COMPONENTS..], at);
        }
    }
}

/// How the material lies: the rotation of its axes since they were x, y, z. Not turned at the start unless
/// the law says otherwise.
#[derive(Clone, Copy, Debug)]
pub struct Orientation<L: Lane, T: SymmetricTensor<L>>(pub T::Rotation);

impl<L: Lane, T: SymmetricTensor<L>> State<L> for Orientation<L, T> {
    const COUNT: usize = <T::Rotation as Turn<L>>::COMPONENTS;
    #[inline(always)]
    fn zero() -> Self {
        Self(T::Rotation::none())
    }
    #[inline(always)]
    fn load(from: &[Batch], at: usize) -> Self {
        Self(T::Rotation::load(from, at))
    }
    #[inline(always)]
    fn store(self, to: &mut [Batch], at: usize) {
        self.0.store(to, at);
    }
}

/// First the one, then the other.
impl<L: Lane, A: State<L>, B: State<L>> State<L> for (A, B) {
    const COUNT: usize = A::COUNT + B::COUNT;
    #[inline(always)]
    fn zero() -> Self {
        (A::zero(), B::zero())
    }
    #[inline(always)]
    fn load(from: &[Batch], at: usize) -> Self {
        (A::load(from, at), B::load(&from[A::COUNT..], at))
    }
    #[inline(always)]
    fn store(self, to: &mut [Batch], at: usize) {
        self.0.store(to, at);
        self.1.store(&mut to[A::COUNT..], at);
    }
}
