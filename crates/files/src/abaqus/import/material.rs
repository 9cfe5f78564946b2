//! Materials of a deck.

use super::Importer;
use super::report::Outcome::Approximated;
use crate::abaqus::messages::{NO_COUNTERPART, SYNTAX, UNKNOWN};
use crate::abaqus::text::{folded, shown};
use embate_solver::error::Fault;

/// A material as the deck has it.
#[derive(Clone, Debug, Default)]
pub(super) struct Material {
    pub(super) name: String,
    pub(super) density: Option<f64>,
    /// Young's modulus and Poisson's ratio.
    pub(super) elastic: Option<[f64; 2]>,
    /// Stress and plastic strain.
    pub(super) plastic: Vec<[f64; 2]>,
    /// C10, C01 and the bulk modulus.
    pub(super) rubber: Option<[f64; 3]>,
}

pub(super) fn material(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    let block = importer.block(at);
    let Some(name) = block.parameter("NAME").filter(|name| !name.is_empty()) else {
        return Err(importer.text.fault(&SYNTAX, block.line, "*MATERIAL has no name", "add NAME=..."));
    };
    if importer.materials.iter().any(|it| folded(&it.name) == folded(name)) {
        return Err(importer.text.fault(&UNKNOWN, block.line, format!("a second material {}", shown(name)), "give it another name"));
    }
    importer.materials.push(Material { name: name.to_string(), ..Material::default() });
    Ok(())
}

/// The material that a block belongs to.
fn current<'b>(importer: &'b mut Importer<'_>, at: usize) -> Result<&'b mut Material, Fault> {
    let block = importer.block(at);
    let fault =
        importer.text.fault(&SYNTAX, block.line, format!("*{} belongs to no material", block.keyword), "it stands below a *MATERIAL");
    importer.materials.last_mut().ok_or(fault)
}

fn rows_left_out(importer: &mut Importer<'_>, at: usize) {
    if let Some(&line) = importer.block(at).data.get(1) {
        importer.ignored(at, line, "only the first data line is read: values at other temperatures do not act");
    }
}

pub(super) fn density(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    let numbers = importer.first_numbers(at, "a density")?;
    let value = importer.needed(at, &numbers, 0, "a density")?;
    current(importer, at)?.density = Some(value);
    rows_left_out(importer, at);
    Ok(())
}

pub(super) fn elastic(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    let block = importer.block(at);
    if block.has("TYPE") && !block.is("TYPE", "ISOTROPIC") && !block.is("TYPE", "ISO") {
        let message =
            format!("elasticity of the type {} has no counterpart in the import", shown(block.parameter("TYPE").unwrap_or_default()));
        return Err(importer.text.fault(
            &NO_COUNTERPART,
            block.line,
            message,
            "give an isotropic material, or write the model file by hand",
        ));
    }
    let numbers = importer.first_numbers(at, "an elastic constant")?;
    let young = importer.needed(at, &numbers, 0, "Young's modulus")?;
    let poisson = numbers.get(1).copied().flatten().unwrap_or(0.0);
    current(importer, at)?.elastic = Some([young, poisson]);
    rows_left_out(importer, at);
    Ok(())
}

pub(super) fn plastic(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    let block = importer.block(at);
    if block.has("HARDENING") && !block.is("HARDENING", "ISOTROPIC") {
        let message = format!("hardening {} has no counterpart in the import", shown(block.parameter("HARDENING").unwrap_or_default()));
        return Err(importer.text.fault(
            &NO_COUNTERPART,
            block.line,
            message,
            "give a table of isotropic hardening, or write the model file by hand",
        ));
    }
    let mut rows: Vec<[f64; 2]> = Vec::new();
    let mut temperature = None;
    for &line in &block.data {
        let numbers = importer.numbers(line, "a number of the yield curve")?;
        let at_temperature = numbers.get(2).copied().flatten();
        if temperature.get_or_insert(at_temperature) != &at_temperature {
            importer.ignored(at, line, "yield stresses at other temperatures than the first do not act");
            break;
        }
        let stress = importer.needed(at, &numbers, 0, "a yield stress")?;
        rows.push([stress, numbers.get(1).copied().flatten().unwrap_or(0.0)]);
    }
    if rows.first().is_none_or(|row| row[1] != 0.0) || rows.windows(2).any(|pair| pair[1][1] <= pair[0][1]) {
        let message = "the yield curve does not begin at plastic strain 0, or its strains do not rise";
        return Err(importer.text.fault(&SYNTAX, block.line, message, "each data line is yield stress, plastic strain"));
    }
    current(importer, at)?.plastic = rows;
    Ok(())
}

pub(super) fn hyperelastic(importer: &mut Importer<'_>, at: usize) -> Result<(), Fault> {
    let block = importer.block(at);
    let mooney = block.has("MOONEY-RIVLIN");
    if !mooney && !block.has("NEO HOOKE") || block.has("TEST DATA INPUT") {
        let help = "NEO HOOKE and MOONEY-RIVLIN with coefficients are read; for others write the model file by hand";
        return Err(importer.text.fault(&NO_COUNTERPART, block.line, "a strain energy that has no counterpart in the import", help));
    }
    let numbers = importer.first_numbers(at, "a coefficient of the strain energy")?;
    let c10 = importer.needed(at, &numbers, 0, "C10")?;
    let c01 = if mooney { importer.needed(at, &numbers, 1, "C01")? } else { 0.0 };
    let d1 = numbers.get(if mooney { 2 } else { 1 }).copied().flatten().unwrap_or(0.0);
    // An explicit computation needs a finite bulk modulus: 20 times the shear modulus, Poisson's ratio 0.475.
    let bulk = if d1 > 0.0 { 2.0 / d1 } else { 40.0 * (c10 + c01) };
    current(importer, at)?.rubber = Some([c10, c01, bulk]);
    if d1 <= 0.0 {
        importer.note(
            at,
            Approximated,
            "D1 = 0: the bulk modulus is 20 times the shear modulus (Poisson's ratio \
            0.475), as an explicit computation needs one; the energy of volume is K/4 (J^2 - 1 - 2 ln J)",
        );
    }
    rows_left_out(importer, at);
    Ok(())
}
