//! Messages of contacts and obstacles.

use crate::message::{Example, Message};

pub(crate) static MESSAGES: &[&Message] = &[
    &SHARED_SURFACE,
    &NOTHING_GIVES_WAY,
    &COMBINATION,
    &JOINED_TWICE,
    &PRESSURES,
    &FRICTION,
    &PENETRATION,
    &TIE,
    &TIED_TWICE,
    &ON_SYMMETRY,
    &OBSTACLE,
    &TURNED,
    &OPEN,
    &NO_STEP,
    &IDLE,
    &NO_FORCE,
    &INSIDE_AT_START,
    &TIES_BROKE,
    &UNSOLVED,
    &MISSED,
    &PASSING,
    &ROUGH,
];

pub(crate) static SHARED_SURFACE: Message = Message {
    code: "E0401",
    title: "a surface in contact with itself",
    example: Example::Model("[[contact]]\nname = \"hit\"\nbetween = [\"block\", \"block.right\"]\n"),
    cause: "The two surfaces of `between` are the same or have lines in common.",
    remedy: "Name two different surfaces; for a body that touches itself, name it in `bodies`.",
};

pub(crate) static NOTHING_GIVES_WAY: Message = Message {
    code: "E0402",
    title: "a contact of bodies whose motion is all prescribed",
    example: Example::Model(
        "[[part]]\nname = \"block\"\nmaterial = \"steel\"\nrigid = { x = 0, y = 0, rotation = 0 }\nrectangle = { corner = [0, 0], size = [\"10 mm\", \"10 mm\"], elements = [2, 2] }\n\n\
         [[contact]]\nname = \"self\"\nbodies = \"all\"\n",
    ),
    cause: "All bodies here are rigid and prescribed, so no force changes anything.",
    remedy: "Let one of them deform, or be free in x, y or rotation; or leave the contact out.",
};

pub(crate) static COMBINATION: Message = Message {
    code: "E0403",
    title: "a formulation, law or tie that don't go together",
    example: Example::Model(
        "[[contact]]\nname = \"hit\"\nbetween = [\"block.right\", \"wall.left\"]\nformulation = \"pinball\"\ntied = true\n",
    ),
    cause: "Pinballs only push, segments have no slave nodes, pressures hold nothing together, and bodies have no slave.",
    remedy: "Take what the message suggests; docs/model-file.md says what goes with what.",
};

pub(crate) static JOINED_TWICE: Message = Message {
    code: "E0404",
    title: "two contacts of the same surfaces",
    example: Example::Model(
        "[[contact]]\nname = \"hit\"\nbetween = [\"block.right\", \"wall.left\"]\n\n[[contact]]\nname = \"again\"\nbodies = \"all\"\n",
    ),
    cause: "Both would push, so the surfaces would be twice as stiff, and friction would be counted twice.",
    remedy: "Leave one of them out, or let one end (`death`) before the other begins (`birth`).",
};

pub(crate) static PRESSURES: Message = Message {
    code: "E0405",
    title: "a table of pressures that is no contact law",
    example: Example::Model(
        "[[contact]]\nname = \"hit\"\nbetween = [\"block.right\", \"wall.left\"]\nlaw = \"pressure_gap\"\ngaps = \
            [\"-1 mm\", 0]\npressures = [0, \"1 MPa\"]\n",
    ),
    cause: "The pressure must fall with the gap and end with zero, else surfaces pull or push each other from far away.",
    remedy: "Give pressures from the deepest penetration to the widest gap, the last one 0.",
};

pub(crate) static FRICTION: Message = Message {
    code: "E0406",
    title: "static and dynamic friction that don't fit",
    example: Example::Model(
        "[[contact]]\nname = \"hit\"\nbetween = [\"block.right\", \"wall.left\"]\nfriction = 0.1\nfriction_dynamic = \
            0.3\nfriction_decay = \"0.1 s/m\"\n",
    ),
    cause: "Dynamic friction is at most the static one, and is reached only with a decay.",
    remedy: "Give `friction`, a smaller `friction_dynamic`, and `friction_decay`.",
};

pub(crate) static PENETRATION: Message = Message {
    code: "E0407",
    title: "bodies that are inside of each other at the start",
    example: Example::Model("[[obstacle]]\nname = \"ground\"\nplane = { point = [0, \"1 mm\"], normal = [0, 1] }\n"),
    cause: "Nodes lie behind the surface that they touch (with the thickness of the contact): its springs would shoot them out.",
    remedy: "Move the bodies apart, or set `initial_penetration` to \"push_out\" or \"ignore\". Where all of the bodies is behind an \
        obstacle its normal looks away from them: turn it.",
};

pub(crate) static TIE: Message = Message {
    code: "E0408",
    title: "a tie that binds nothing",
    example: Example::Model("[[contact]]\nname = \"hit\"\nbetween = [\"block.left\", \"wall.right\"]\ntied = true\n"),
    cause: "Nothing of one surface lies near the other one.",
    remedy: "Let the surfaces touch, raise `thickness`, or leave `tied` out.",
};

pub(crate) static TIED_TWICE: Message = Message {
    code: "E0409",
    title: "a node in two ties",
    example: Example::Model(
        "[[part]]\nname = \"block\"\nmaterial = \"steel\"\nrectangle = { corner = [0, 0], size = [\"10 mm\", \"10 \
            mm\"], elements = [2, 2] }\n\n[[part]]\nname = \"lower\"\nmaterial = \"steel\"\nrectangle = { corner = \
            [\"10 mm\", \"-5 mm\"], size = [\"10 mm\", \"10 mm\"], elements = [2, 2] }\n\n[[part]]\nname = \"upper\"\nmaterial \
            = \"steel\"\nrectangle = { corner = [\"10 mm\", \"5 mm\"], size = [\"10 mm\", \"10 mm\"], elements = [2, \
            2] }\n\n[[contact]]\nname = \"one\"\nbetween = [\"block.right\", \"lower.left\"]\ntied = \
            true\n\n[[contact]]\nname = \"two\"\nbetween = [\"block.right\", \"upper.left\"]\ntied = true\n",
    ),
    cause: "Two ties would hold one node against each other.",
    remedy: "Leave one of the two out, name smaller surfaces, or let the other surface be the slave.",
};

pub(crate) static ON_SYMMETRY: Message = Message {
    code: "E0410",
    title: "a surface that is all on a symmetry line",
    example: Example::Model(
        "[[symmetry]]\npoint = [0, 0]\nnormal = [1, 0]\nparts = [\"block\"]\n\n[[contact]]\nname = \"hit\"\nbetween \
            = [\"block.left\", \"wall.left\"]\n",
    ),
    cause: "On a symmetry line the body continues: there is no surface.",
    remedy: "Name another surface.",
};

pub(crate) static OBSTACLE: Message = Message {
    code: "E0411",
    title: "an obstacle that has no shape",
    example: Example::Model("[[obstacle]]\nname = \"ground\"\npolyline = { points = [[0, \"-5 mm\"], [0, \"-5 mm\"]] }\n"),
    cause: "A polyline needs two different points, and goes nowhere back on itself; a hollow circle must be larger than the thickness.",
    remedy: "Correct the points or the radius.",
};

pub(crate) static TURNED: Message = Message {
    code: "E0413",
    title: "triangles of an obstacle that make no surface",
    example: Example::Shell(
        "printf 'solid two\\n facet normal 0 0 1\\n outer loop\\n vertex -1 -1 0\\n vertex 1 -1 0\\n vertex 1 1 0\\n endloop\\n endfacet\\n facet normal 0 0 -1\\n outer loop\\n \
         vertex -1 -1 0\\n vertex -1 1 0\\n vertex 1 1 0\\n endloop\\n endfacet\\nendsolid two\\n' > two.stl\n\
         embate check model.toml --set 'part=[{name=\"b\",material=\"steel\",box={corner=[0,0,0],size=[1,1,1],elements=[1,1,1]}}]' --set 'contact=[]' --set 'obstacle=[{stl={file=\"two.stl\"}}]'\n",
    ),
    cause: "Two triangles that have an edge in common face opposite sides there, or more than two share it, so that \
        inside and outside are undefined.",
    remedy: "Repair the surface in the program that made it: all normals outward, nothing twice, each body closed.",
};

pub(crate) static NO_STEP: Message = Message {
    code: "E0412",
    title: "a penalty from a time step that nothing gives",
    example: Example::Model(
        "[[part]]\nname = \"block\"\nmaterial = \"steel\"\nrigid = true\nvelocity = [\"10 m/s\", 0]\nrectangle = { \
            corner = [0, 0], size = [\"10 mm\", \"10 mm\"], elements = [2, 2] }\n\n[[part]]\nname = \"wall\"\nmaterial \
            = \"steel\"\nrigid = true\nrectangle = { corner = [\"10.01 mm\", \"-5 mm\"], size = [\"10 mm\", \"20 \
            mm\"], elements = [2, 4] }\n\n[[contact]]\nname = \"hit\"\nbetween = [\"block.right\", \"wall.left\"]\npenalty_from \
            = \"time_step\"\n",
    ),
    cause: "The step comes from elements, and rigid parts have none that deform.",
    remedy: "Give `time_step` in `[run]`, or take another `penalty_from`.",
};

pub(crate) static IDLE: Message = Message {
    code: "W0401",
    title: "nothing acts on a part",
    example: Example::Model(
        "[[part]]\nname = \"block\"\nmaterial = \"steel\"\nvelocity = [1, 0]\nrectangle = { corner = [0, 0], size = [\"10 mm\", \"10 mm\"], elements = [2, 2] }\n\n\
         [[part]]\nname = \"other\"\nmaterial = \"steel\"\nrectangle = { corner = [\"5 mm\", 0], size = [\"10 mm\", \"10 mm\"], elements = [2, 2] }\n\n\
         [[contact]]\nname = \"self\"\nbodies = [\"block\"]\n",
    ),
    cause: "No contact, obstacle, joint, load or motion has to do with the part: it stays as it is, and others go through it.",
    remedy: "Name it in a contact, move it or load it, or leave it out.",
};

pub(crate) static OPEN: Message = Message {
    code: "W0407",
    title: "the surface of an obstacle is not closed",
    example: Example::Shell(
        "printf 'solid one\\n facet normal 0 0 1\\n outer loop\\n vertex -1 -1 0\\n vertex 1 -1 0\\n vertex 1 1 0\\n endloop\\n endfacet\\nendsolid one\\n' > one.stl\n\
         embate check model.toml --set 'part=[{name=\"b\",material=\"steel\",box={corner=[0,0,0],size=[1,1,1],elements=[1,1,1]}}]' --set 'contact=[]' --set 'obstacle=[{stl={file=\"one.stl\"}}]'\n",
    ),
    cause: "Some edges of the triangles have a triangle on one side alone: the surface is a sheet, or has holes, or \
        the corners of neighbours differ in their last digits.",
    remedy: "Of a sheet nothing is to be done if bodies meet its front and stay within its rim. Else close the \
        surface in the program that made it, or merge its points.",
};

pub(crate) static NO_FORCE: Message = Message {
    code: "W0402",
    title: "a contact that transmitted nothing",
    example: Example::Model("[run]\nend = \"0.1 us\"\n"),
    cause: "In the whole run no two surfaces of it touched.",
    remedy: "Look whether the run is long enough, the bodies move towards each other, and the contact names the surfaces that meet.",
};

pub(crate) static INSIDE_AT_START: Message = Message {
    code: "W0403",
    title: "nodes that were inside other bodies at the start",
    example: Example::Model(
        "[[part]]\nname = \"wall\"\nmaterial = \"steel\"\nrectangle = { corner = [\"9.9 mm\", \"-5 mm\"], size = [\"10 mm\", \"20 mm\"], elements = [2, 4] }\n\n\
         [[part]]\nname = \"block\"\nmaterial = \"steel\"\nvelocity = [\"10 m/s\", 0]\nrectangle = { corner = [0, 0], size = [\"10 mm\", \"10 mm\"], elements = [2, 2] }\n\n\
         [[contact]]\nname = \"hit\"\nbetween = [\"block.right\", \"wall.left\"]\ninitial_penetration = \"ignore\"\n",
    ),
    cause: "`initial_penetration` lets the model be accepted: the nodes were pushed out, or the contact forgives what they began with.",
    remedy: "`embate check` says how many there are, and where the deepest is; move the bodies apart where results near the contact matter.",
};

pub(crate) static TIES_BROKE: Message = Message {
    code: "W0404",
    title: "ties that broke, or that bound nothing",
    example: Example::Model(
        "[[part]]\nname = \"block\"\nmaterial = \"steel\"\nvelocity = [\"-10 m/s\", 0]\nrectangle = { corner = [0, \
            0], size = [\"10 mm\", \"10 mm\"], elements = [2, 2] }\n\n[[part]]\nname = \"wall\"\nmaterial = \"steel\"\nrectangle \
            = { corner = [\"10 mm\", \"-5 mm\"], size = [\"10 mm\", \"20 mm\"], elements = [2, 4] \
            }\n\n[[contact]]\nname = \"hit\"\nbetween = [\"block.right\", \"wall.left\"]\ntied = true\ntie_strength \
            = \"10 MPa\"\n",
    ),
    cause: "The force in a tie went over its strength, or the parts that it held were eroded.",
    remedy: "Nothing, where that is what is computed; else raise `tie_strength`.",
};

pub(crate) static UNSOLVED: Message = Message {
    code: "W0405",
    title: "contact forces that were not solved to the last digit",
    example: Example::Words("Many very stiff springs press on each other in one step."),
    cause: "The sweeps over the springs of a step ended before their forces agreed: penalties are far stiffer than the bodies.",
    remedy: "Lower the contact penalties (`penalty_scale`), and look at the energy drift.",
};

pub(crate) static MISSED: Message = Message {
    code: "W0406",
    title: "bodies inside each other that nothing holds apart",
    example: Example::Words("Two parts that no contact names go through each other next to a contact."),
    cause: "A node came in where no contact watches, a body went through itself, or bodies overlap by more than a \
        sixth of their thickness (in 2D a fifth).",
    remedy: "Look at the place that the message names. Let one contact of `bodies = \"all\"` watch all surfaces; \
        raise `penalty_scale` where a contact is too soft for what presses on it.",
};

pub(crate) static PASSING: Message = Message {
    code: "W0408",
    title: "bodies that will go through each other",
    example: Example::Model(
        "[run]\nend = \"100 us\"\n\n[[part]]\nname = \"ball\"\nmaterial = \"steel\"\nvelocity = [\"200 m/s\", 0]\ndisk = { centre = [0, 0], radius = \"4 mm\", elements = 2 }\n\n\
         [[part]]\nname = \"plate\"\nmaterial = \"steel\"\nrectangle = { corner = [\"10 mm\", \"-10 mm\"], size = [\"2 mm\", \"20 mm\"], elements = [1, 10] }\n\n\
         [[contact]]\nname = \"self\"\nbodies = [\"plate\"]\n",
    ),
    cause: "Bodies move towards each other, or towards an obstacle, on straight ways that nothing changes before they meet, and no \
        contact has to do with both: without a contact nothing keeps bodies apart.",
    remedy: "Add a contact of both, such as `bodies = \"all\"`; name the part in the `parts` of the obstacle.",
};

pub(crate) static ROUGH: Message = Message {
    code: "W0409",
    title: "a coefficient of friction that no surfaces have",
    example: Example::Model("[[contact]]\nname = \"hit\"\nbetween = [\"block.right\", \"wall.left\"]\nfriction = 20\n"),
    cause: "A coefficient of friction between 3 and 90 is more than that of rubber on a road by far: most often an angle of friction in \
        degrees was written.",
    remedy: "Write the tangent of the angle: 0.364 for 20 degrees. Bind what shall not slide by `tied`. Nothing, where it is meant.",
};
