//! Every switch of the thesis's input file that has a counterpart here is named, with its numbers, by the key that it became.

use scene::schema;

/// What became of the switches of `INDAT`, by their numbers in its list: M. Pilorget 2010, appendix 2 (section 7.2, after
/// page 80 of 94). Number, switch and values as our key's doc writes them, key.
#[rustfmt::skip]
const SWITCHES: [(u32, &str, &str); 28] = [
    (1, "INDAT i_kernel 1 | 2 | 3 | 5: gaussian, quadratic, cubic_spline, wendland_c2", "fluid.kernel"),
    (2, "INDAT i_algorithm 1 | 2 | 3: predictor_corrector, verlet, beeman", "fluid.integrator"),
    (3, "INDAT i_densityFilter 0 | 1 | 2", "fluid.density_filter"),
    (4, "INDAT i_viscos 1: viscos_val", "fluid.artificial_viscosity"),
    (4, "INDAT i_viscos 2 | 3: viscos_val", "fluid.kinematic_viscosity"),
    (4, "INDAT i_viscos 2 | 3", "fluid.turbulence"),
    (5, "INDAT iBC 1 | 2: repulsive, dynamic", "fluid.walls"),
    (6, "INDAT lattice 1 | 2: SC | BCC", "resolution.lattice"),
    (7, "INDAT i_EoS 1 | 2", "fluid.equation_of_state"),
    (8, "INDAT h_SWL", "tank.depth"),
    (10, "INDAT gamma", "fluid.eos_exponent"),
    (11, "INDAT coef, which makes B", "fluid.sound_speed"),
    (12, "INDAT eps, there 0.5", "fluid.xsph"),
    (13, "INDAT rho0", "fluid.density"),
    (14, "viscos_val", "fluid.artificial_viscosity"),
    (14, "viscos_val", "fluid.kinematic_viscosity"),
    (16, "INDAT vlx", "tank.width"),
    (18, "INDAT vlz", "tank.height"),
    (19, "INDAT dx", "resolution.spacing"),
    (20, "dy", "resolution.spacing"),
    (22, "INDAT h)", "fluid.smoothing_ratio"),
    (26, "INDAT ivar_dt 0", "time.step"),
    (27, "and dt", "time.step"),
    (28, "INDAT i_correct_pb 0 | 1", "fluid.limit_pressure"),
    (35, "ZZMAX", "tank.depth"),
    (36, "INDAT CFL_number", "fluid.cfl"),
    (37, "INDAT TE0", "fluid.temperature"),
    (38, "INDAT fex 1 | 2 | 3: FEX_2D, FEX_2D2, FEX_2D3", "report.force_rules"),
];

/// What has no key: 9 B follows from the sound speed, 15 visc_wall is a term that the repulsive wall (LE15) does not have,
/// 17 vly and 21 dz belong to a third dimension or to the one spacing, 23 to 25 NP, NB, NBF are counted, 29 to 34 XMIN to
/// ZMAX are the tank's walls.
const WITHOUT_A_KEY: [u32; 13] = [9, 15, 17, 21, 23, 24, 25, 29, 30, 31, 32, 33, 34];

#[test]
fn every_legacy_switch_is_named_by_the_key_that_it_became() {
    for (number, said, key) in SWITCHES {
        let keyword = schema().keywords().iter().find(|keyword| keyword.path == key);
        let doc = keyword.unwrap_or_else(|| panic!("{number}: no key {key}")).doc.as_str();
        assert!(doc.contains(said) && doc.contains("INDAT"), "{number}: {said:?} is not in the doc of {key}: {doc}");
    }
    let mut accounted: Vec<u32> = SWITCHES.iter().map(|switch| switch.0).chain(WITHOUT_A_KEY).collect();
    accounted.sort_unstable();
    accounted.dedup();
    assert_eq!(accounted, (1..=38).collect::<Vec<_>>(), "a switch of the list is forgotten");
}
