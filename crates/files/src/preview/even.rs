//! Some of many points, spread evenly: glyphs on all of them would hide the body.

/// So many points for each that is wanted are looked at one by one.
const LOOKED_AT: usize = 40;
/// Halvings of the distance between points.
const ROUNDS: usize = 14;

/// Indices of at most `most` of the points, ascending, none nearer to another than the farthest distance that
/// leaves so many: of points in a row each second, third, ... one.
pub(super) fn even(points: &[[f64; 3]], most: usize) -> Vec<usize> {
    let all: Vec<usize> = (0..points.len()).filter(|&index| points[index].iter().all(|x| x.is_finite())).collect();
    if all.len() <= most {
        return all;
    }
    let low = all.iter().fold([f64::INFINITY; 3], |low, &index| [0, 1, 2].map(|d| low[d].min(points[index][d])));
    let longest = all.iter().flat_map(|&index| [0, 1, 2].map(|d| points[index][d] - low[d])).fold(0.0, f64::max);
    if !(longest > 0.0 && longest.is_finite()) {
        return all[..1].to_vec();
    }
    let place = |index: usize| [0, 1, 2].map(|d| (points[index][d] - low[d]) / longest);
    let all = thinned(all, place, LOOKED_AT * most.max(1));
    let taken = |apart: f64| {
        let mut taken: Vec<usize> = Vec::new();
        for &index in &all {
            let x = place(index);
            let is_near = |&other: &usize| (0..3).map(|d| (place(other)[d] - x[d]).powi(2)).sum::<f64>() < apart * apart;
            if taken.len() <= most && !taken.iter().rev().any(is_near) {
                taken.push(index);
            }
        }
        taken
    };
    let (mut near, mut far) = (0.0, 2.0);
    for _ in 0..ROUNDS {
        let middle = 0.5 * (near + far);
        if taken(middle).len() <= most { far = middle } else { near = middle }
    }
    taken(far)
}

/// Of each cube of the finest grid that leaves at most `most` points the first, where there are more.
fn thinned(all: Vec<usize>, place: impl Fn(usize) -> [f64; 3], most: usize) -> Vec<usize> {
    if all.len() <= most {
        return all;
    }
    let places: Vec<[f64; 3]> = all.iter().map(|&index| place(index)).collect();
    // Cubes, each with the first point in it.
    let of_grid = |count: usize| {
        let cube =
            |(k, x): (u32, &[f64; 3])| x.iter().fold(0, |cube, x| cube << 32 | u128::from((x * count as f64) as u32)) << 32 | u128::from(k);
        let mut cubes: Vec<u128> = (0..).zip(&places).map(cube).collect();
        cubes.sort_unstable();
        cubes.dedup_by_key(|cube| *cube >> 32);
        cubes
    };
    // On a surface there are as many cubes as the square of their number along an edge; in a row they are
    // fewer.
    let (mut least, mut over) = (1, most + 1);
    while over - least > 1 {
        let middle = if over > 8 * least { 2 * least } else { usize::midpoint(least, over) };
        if of_grid(middle).len() <= most { least = middle } else { over = middle }
    }
    let mut taken: Vec<usize> = of_grid(least).into_iter().map(|cube| all[cube as u32 as usize]).collect();
    taken.sort_unstable();
    taken
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_points_in_a_row_each_so_many_th_one_is_taken() {
        let line: Vec<[f64; 3]> = (0..100).map(|k| [f64::from(k), 0.0, 0.0]).collect();
        assert_eq!(even(&line[..20], 20).len(), 20);
        assert_eq!(even(&line, 20), (0..100).step_by(5).collect::<Vec<_>>());
        assert_eq!(even(&line, 30), (0..100).step_by(4).collect::<Vec<_>>());
    }

    #[test]
    fn of_many_points_of_a_surface_about_as_many_as_wanted_are_taken_and_none_is_near_another() {
        let square: Vec<[f64; 3]> = (0..90_000).map(|k| [f64::from(k % 300), f64::from(k / 300), 0.0]).collect();
        let taken = even(&square, 60);
        assert!(taken.len() > 30 && taken.len() <= 60, "{}", taken.len());
        let apart = |a: usize, b: usize| (0..2).map(|d| (square[a][d] - square[b][d]).powi(2)).sum::<f64>().sqrt();
        let nearest =
            taken.iter().flat_map(|&a| taken.iter().filter(move |&&b| b != a).map(move |&b| apart(a, b))).fold(f64::INFINITY, f64::min);
        assert!(nearest > 25.0, "{nearest}");
    }

    #[test]
    fn points_in_one_place_or_nowhere_do_no_harm() {
        assert_eq!(even(&[[1.0; 3]; 50], 10), [0]);
        assert_eq!(even(&[[f64::NAN; 3], [0.0; 3]], 10), [1]);
        assert!(even(&[], 10).is_empty() && even(&[[-1e308; 3], [1e308; 3], [0.0; 3]], 2).len() <= 2);
    }
}
