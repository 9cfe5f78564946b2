//! Messages of materials that several laws share; those of one law stand in its file.

use crate::message::{Example, Message};

pub(crate) static MESSAGES: &[&Message] = &[
    &PARAMETER_MISSING,
    &PARAMETER_UNKNOWN,
    &EQUATION_OF_STATE,
    &PARAMETERS,
    &SOFTENS_TOO_STEEPLY,
    &INITIAL_STATE,
    &CRITERION,
    &UNSTABLE_RUBBER,
    &NO_STIFFNESS,
    &SOFTENING,
    &LOCKING,
    &FLUID,
    &IMPLAUSIBLE,
    &OTHER_UNITS,
];

pub(crate) static PARAMETER_MISSING: Message = Message {
    code: "E0301",
    title: "a law lacks a parameter",
    example: Example::Words("A program that makes its models itself leaves out a parameter of a law; of a model file that is E0107."),
    cause: "Every parameter without a default must be given.",
    remedy: "Add it; `embate list laws` names all with their units.",
};

pub(crate) static PARAMETER_UNKNOWN: Message = Message {
    code: "E0302",
    title: "a law has no such parameter",
    example: Example::Words(
        "A program that makes its models itself gives a parameter that the law has not; of a model file that is E0106.",
    ),
    cause: "The parameter belongs to another law or to an equation of state, or its name is misspelt.",
    remedy: "Leave it out, or take the law that has it; `embate list laws` names all.",
};

pub(crate) static EQUATION_OF_STATE: Message = Message {
    code: "E0303",
    title: "a law and an equation of state that don't go together",
    example: Example::Model(
        "[material.steel]\nlaw = \"null\"\n\n[material.rubber]\nlaw = \"neo_hookean\"\ndensity = 1000\nshear = \"1 \
            MPa\"\nbulk = \"1 GPa\"\neos = \"linear\"\n",
    ),
    cause: "Fluids have no pressure of their own and need an equation of state; rubbers and laws that flow in volume \
        have one, which it would contradict.",
    remedy: "Give `eos` to a fluid, and leave it out where the law has a pressure.",
};

pub(crate) static PARAMETERS: Message = Message {
    code: "E0304",
    title: "parameters of a law contradict each other",
    example: Example::Model(
        "[material.soil]\nlaw = \"drucker_prager\"\ndensity = 2000\nyoung = \"50 MPa\"\npoisson = 0.3\ncohesion = \"10 \
            kPa\"\nfriction_angle = 0.35\ndilation_angle = 0.5\n",
    ),
    cause: "Each is within its range, but together they make a material that gives energy for nothing, has no stiffness or no strength.",
    remedy: "Look at signs, units and the order in which they are given; the message says what must hold.",
};

pub(crate) static SOFTENS_TOO_STEEPLY: Message = Message {
    code: "E0305",
    title: "a flow stress that falls too steeply",
    example: Example::Model("[material.steel]\nlaw = \"j2\"\nyield = \"300 MPa\"\nhardening = \"-240 GPa\"\n"),
    cause: "The flow stress falls by more per plastic strain than elastic unloading gives back: strain has no sound answer there.",
    remedy: "Let it fall more slowly, or let elements fail by `failure`.",
};

pub(crate) static INITIAL_STATE: Message = Message {
    code: "E0306",
    title: "a law can't hold what a part begins with",
    example: Example::Model(
        "[[part]]\nname = \"block\"\nmaterial = \"steel\"\ntemperature_initial = \"400 K\"\nrectangle = { corner = [0, 0], size = [\"10 mm\", \"10 mm\"], elements = [2, 2] }\n\n\
         [[contact]]\nname = \"self\"\nbodies = \"all\"\n",
    ),
    cause: "The law has no temperature, keeps its stress in a way that can't be given from outside, or would flow at \
        once under the stress; or the part is rigid.",
    remedy: "Leave the initial state out, give less stress, or take another law.",
};

pub(crate) static CRITERION: Message = Message {
    code: "E0307",
    title: "a failure criterion that the law can't feed",
    example: Example::Model("[material.steel]\nfailure = { plastic_strain = 0.3 }\n"),
    cause: "The criterion looks at a quantity that the law does not compute: plastic strain of an elastic law, damage of one without.",
    remedy: "Take another criterion, or a law that has the quantity.",
};

pub(crate) static NO_STIFFNESS: Message = Message {
    code: "E0308",
    title: "damping by stiffness of a law without one",
    example: Example::Model(
        "[material.steel]\nlaw = \"neo_hookean\"\nshear = \"1 MPa\"\nbulk = \"100 MPa\"\n\n[[load]]\ndamping_stiffness = \"1 us\"\n",
    ),
    cause: "`damping_stiffness` needs an isotropic law in rate form, such as `elastic` or `j2`.",
    remedy: "Name the parts that have such a law in `parts`; damp rubber by `damping`, or take `viscoelastic`.",
};

pub(crate) static SOFTENING: Message = Message {
    code: "W0301",
    title: "a flow stress that falls",
    example: Example::Model("[material.steel]\nlaw = \"j2\"\nyield = \"300 MPa\"\nhardening = \"-1 GPa\"\n"),
    cause: "Where the flow stress falls the equations lose ellipticity: strain gathers in one row of elements, so \
        that results depend on their size.",
    remedy: "Fit the fall to the size of the elements, or let the flow stress stay at its peak and elements fail by `failure`.",
};

pub(crate) static LOCKING: Message = Message {
    code: "W0302",
    title: "elements that lock",
    example: Example::Model(
        "[material.steel]\npoisson = 0.499\n\n[[part]]\nname = \"block\"\nmaterial = \"steel\"\nelement = \"quad4_full\"\nvelocity \
            = [1, 0]\nrectangle = { corner = [0, 0], size = [\"10 mm\", \"10 mm\"], elements = [2, 2] \
            }\n\n[[contact]]\nname = \"self\"\nbodies = \"all\"\n",
    ),
    cause: "A nearly incompressible material, or one that flows plastically, in elements that hold the volume one by one: bending and \
        shear are several times too stiff, also with many elements. Of triangles and tetrahedra that is the rule: `tri3` and `tet4` are for \
        foams and brittle fragments.",
    remedy: "Take `quad4` for `quad4_full`, `tri6` for triangles, `tet10` for tetrahedra: their meshes of three or four nodes get the others by \
        themselves, and should be coarser.",
};

pub(crate) static FLUID: Message = Message {
    code: "W0303",
    title: "a fluid in elements that can't hold their shape",
    example: Example::Model(
        "[material.water]\nlaw = \"null\"\ndensity = 1000\neos = \"linear\"\nbulk_modulus = \"2 \
            GPa\"\n\n[[part]]\nname = \"pool\"\nmaterial = \"water\"\nvelocity = [1, 0]\nrectangle = { corner = [0, \
            0], size = [\"10 mm\", \"10 mm\"], elements = [2, 2] }\n\n[[contact]]\nname = \"self\"\nbodies = \"all\"\n",
    ),
    cause: "Without viscosity there is a pressure only, one for the whole element, which holds none of the shapes \
        that keep the volume: elements fold.",
    remedy: "Take `quad4_reduced`, whose hourglass control holds them, or give the fluid a `viscosity`.",
};

pub(crate) static IMPLAUSIBLE: Message = Message {
    code: "W0304",
    title: "a number that no material has",
    example: Example::Model("[material.steel]\nlaw = \"elastic\"\ndensity = 7850\nyoung = 210\npoisson = 0.3\n"),
    cause: "A density, a modulus, a wave speed or a yield stress is far from those of all materials: most often a number \
        of another unit was written without it, or the power of ten slipped.",
    remedy: "Write numbers with their units, such as `young = \"210 GPa\"` and `density = \"7.85 g/cm^3\"`. Nothing, where \
        the number is meant.",
};

pub(crate) static OTHER_UNITS: Message = Message {
    code: "W0305",
    title: "materials in another system of units",
    example: Example::Model("[material.steel]\nlaw = \"elastic\"\ndensity = 7.85e-9\nyoung = 210000\npoisson = 0.3\n"),
    cause: "Numbers without a unit are in SI: m, kg, s, Pa. Density and modulus are those of no material there, and those of a \
        usual one in the system that the message names, such as mm, t, s with stresses in MPa.",
    remedy: "Write the numbers with the units that the message names, lengths and velocities too; of a mesh file `scale` is the \
        unit of its lengths.",
};

pub(crate) static UNSTABLE_RUBBER: Message = Message {
    code: "E0309",
    title: "a rubber that would soften to nothing",
    example: Example::Model("[material.rubber]\nlaw = \"ogden\"\ndensity = 1000\nbulk = \"1 GPa\"\nmu = [\"1 MPa\"]\nalpha = [-2]\n"),
    cause: "The constants, often of a fit, make an energy that falls with stretch: the rubber is unstable beyond some point.",
    remedy: "Give each modulus the sign of its exponent, raise the coefficients that the message names, or fit again \
        with that as a condition.",
};
