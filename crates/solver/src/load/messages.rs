//! Messages of loads, curves, prescribed motion, joined nodes, springs and rigid bodies.

use crate::message::{Example, Message};

pub(crate) static MESSAGES: &[&Message] = &[
    &CURVE,
    &EXPRESSION,
    &CURVE_DIMENSION,
    &BEGINNING,
    &INERTIA,
    &RIGID,
    &PRESCRIBED_TWICE,
    &NO_EFFECT,
    &JUMP,
    &FORCE_ON_PART,
    &TO_ITSELF,
    &NO_PARTNER,
    &HELD_TWICE,
    &OFF_SYMMETRY,
    &CONNECTION,
    &HINGE,
    &OPEN_CAVITY,
    &WRONG_SIDE,
    &SPEED,
    &FALLING,
];

pub(crate) static CURVE: Message = Message {
    code: "E0501",
    title: "a curve that can't be one",
    example: Example::Model("[curve.free]\ntime = [0]\nvalue = [\"1 m/s\"]\n"),
    cause: "It has no point, or a name that means something else: `free`, or one that begins like a number.",
    remedy: "Give at least one time with its value, and a name that begins with a letter.",
};

pub(crate) static EXPRESSION: Message = Message {
    code: "E0502",
    title: "a formula that can't be computed",
    example: Example::Model("[curve.push]\nexpression = \"2*sin(3*t\"\n"),
    cause: "The text is no formula of the time t, or its value is not finite at some time of the run.",
    remedy: "Write it like \"2*sin(3*t) + exp(-t)\", with the time t in s; the message counts characters from 1.",
};

pub(crate) static CURVE_DIMENSION: Message = Message {
    code: "E0503",
    title: "a curve of another quantity",
    example: Example::Model(
        "[curve.push]\ntime = [0, \"1 ms\"]\nvalue = [0, \"1 mm\"]\n\n[[constraint]]\non = \"wall.right\"\nvelocity = { x = \"push\" }\n",
    ),
    cause: "The values of the curve have units of another quantity than the key that it drives.",
    remedy: "Take a curve of the right quantity, or give its values as numbers without units.",
};

pub(crate) static BEGINNING: Message = Message {
    code: "E0504",
    title: "an initial velocity of what does not move freely",
    example: Example::Model(
        "[[part]]\nname = \"block\"\nmaterial = \"steel\"\nrigid = { x = 0, y = 0, rotation = 0 }\nvelocity = [1, 0]\nrectangle = { corner = [0, 0], size = [\"10 mm\", \"10 mm\"], elements = [2, 2] }\n\n\
         [[part]]\nname = \"wall\"\nmaterial = \"steel\"\nrectangle = { corner = [\"10.01 mm\", \"-5 mm\"], size = [\"10 mm\", \"20 mm\"], elements = [2, 4] }\n",
    ),
    cause: "The motion is prescribed from the first step on, so there is nothing to begin with.",
    remedy: "Leave the initial velocity out, or let the axis be free.",
};

pub(crate) static INERTIA: Message = Message {
    code: "E0505",
    title: "a mass or inertia that is missing or has no effect",
    example: Example::Model(
        "[[obstacle]]\nname = \"ram\"\nplane = { point = [0, \"11 mm\"], normal = [0, -1] }\nmotion = { y = \"free\" }\n",
    ),
    cause: "An obstacle that is free to move needs a mass, one that is free to turn an inertia; where its motion is \
        prescribed they change nothing.",
    remedy: "Add the key, or leave it out, as the message says.",
};

pub(crate) static RIGID: Message = Message {
    code: "E0506",
    title: "a rigid part whose nodes are held, joined or shared",
    example: Example::Model(
        "[[part]]\nname = \"block\"\nmaterial = \"steel\"\nrigid = true\nrectangle = { corner = [0, 0], size = [\"10 mm\", \"10 mm\"], elements = [2, 2] }\n\n\
         [[part]]\nname = \"wall\"\nmaterial = \"steel\"\nrectangle = { corner = [\"10.01 mm\", \"-5 mm\"], size = [\"10 mm\", \"20 mm\"], elements = [2, 4] }\n\n\
         [[constraint]]\non = \"block.left\"\nfixed = \"x\"\n",
    ),
    cause: "The nodes of a rigid part move with it as one, so nothing else can say how one of them moves.",
    remedy: "Prescribe the motion of the part by `rigid`; bind other parts to it by a tied contact.",
};

pub(crate) static PRESCRIBED_TWICE: Message = Message {
    code: "E0507",
    title: "one motion prescribed twice",
    example: Example::Model("[[constraint]]\non = \"wall.right\"\nvelocity = { x = \"1 m/s\" }\nacceleration = { x = \"1 m/s^2\" }\n"),
    cause: "Two keys say how the same nodes move along the same axis, or nodes with a prescribed rotation have a \
        prescribed motion along x or y as well.",
    remedy: "Leave one of the two out.",
};

pub(crate) static NO_EFFECT: Message = Message {
    code: "E0508",
    title: "a condition that does nothing",
    example: Example::Model("[[join]]\nbetween = [\"block.right\", \"wall.left\"]\ntranslation = [0, 0]\n"),
    cause: "A constraint that holds nothing, or an image that moves its set by nothing.",
    remedy: "Say what it holds, such as `fixed = \"x\"`, or leave it out.",
};

pub(crate) static JUMP: Message = Message {
    code: "E0509",
    title: "a displacement that jumps at the start",
    example: Example::Model("[[constraint]]\non = \"wall.right\"\ndisplacement = { x = \"1 mm\" }\n"),
    cause: "Nodes begin where they are; a displacement that is not zero at time 0 would move them at once, with an infinite velocity.",
    remedy: "Name a curve that begins with 0.",
};

pub(crate) static FORCE_ON_PART: Message = Message {
    code: "E0510",
    title: "a force on a whole part",
    example: Example::Model("[[load]]\non = \"block\"\nforce = [\"1 kN/m\", 0]\n"),
    cause: "A force acts on the nodes of a side or group; over a whole part it could be shared in many ways.",
    remedy: "Name a side as part.side or a group; `gravity` acts on whole parts.",
};

pub(crate) static TO_ITSELF: Message = Message {
    code: "E0511",
    title: "a set that is bound to itself",
    example: Example::Model("[[spring]]\nname = \"s\"\nbetween = [\"block.left\", \"block.left\"]\nstiffness = \"1 MN/m/m\"\n"),
    cause: "A spring, a join, a weld or a joint names the same nodes on both sides.",
    remedy: "Name two sets without common nodes.",
};

pub(crate) static NO_PARTNER: Message = Message {
    code: "E0512",
    title: "a node without a partner to be joined to",
    example: Example::Model("[[join]]\nbetween = [\"block.right\", \"wall.left\"]\n"),
    cause: "Joined sets must have their nodes in the same places, or where their image is, within the tolerance.",
    remedy: "Mesh the two alike, or give a larger `tolerance`; a tied contact joins meshes that differ.",
};

pub(crate) static HELD_TWICE: Message = Message {
    code: "E0513",
    title: "a node that two conditions move differently",
    example: Example::Model(
        "[[constraint]]\non = \"wall.right\"\nvelocity = { x = \"1 m/s\" }\n\n[[constraint]]\non = \"wall.bottom\"\nfixed \
            = [\"x\", \"y\"]\n",
    ),
    cause: "Constraints, symmetry lines and joins meet at a node and say different things about it.",
    remedy: "Take the node out of one of the two.",
};

pub(crate) static OFF_SYMMETRY: Message = Message {
    code: "E0514",
    title: "a symmetry line that no node lies on",
    example: Example::Model("[[symmetry]]\npoint = [\"-1 mm\", 0]\nnormal = [1, 0]\n"),
    cause: "Nodes must lie on the line within 1e-9 of the model's extent; so nothing would be held.",
    remedy: "Move the line or the bodies.",
};

pub(crate) static CONNECTION: Message = Message {
    code: "E0515",
    title: "a weld or joint that can't be",
    example: Example::Model("[[weld]]\nbetween = [\"block.right\", \"wall.left\"]\nat = [[\"10 mm\", \"5 mm\", \"1 mm\"]]\n"),
    cause: "The nodes near its point hold no rigid body (they are too few, or on one line), they are far from it, or the kind of joint \
        or its directions do not exist in this dimension.",
    remedy: "Move the point to the surfaces, give a `radius` within which each set has some nodes, or another kind or direction.",
};

pub(crate) static HINGE: Message = Message {
    code: "W0501",
    title: "a join of a shell or beam with a solid that is a hinge",
    example: Example::Model(
        "[[part]]\nname = \"block\"\nmaterial = \"steel\"\nvelocity = [\"10 m/s\", 0]\nrectangle = { corner = [0, 0], size = [\"10 mm\", \"10 mm\"], elements = [2, 2] }\n\n\
         [[part]]\nname = \"wall\"\nmaterial = \"steel\"\nrectangle = { corner = [\"10.01 mm\", \"-5 mm\"], size = [\"10 mm\", \"20 mm\"], elements = [2, 4] }\n\n\
         [[part]]\nname = \"strip\"\nmaterial = \"steel\"\nelement = \"shell2\"\nsection = { thickness = \"1 mm\" }\nline = { points = [[\"-9 mm\", 0], [0, 0]], elements = 4 }\n\n\
         [[join]]\nbetween = [\"strip.end\", \"block.left\"]\n",
    ),
    cause: "Nodes of solids have no rotation, so what is joined to one of them turns freely about it.",
    remedy: "Bind the rim of a shell by a contact with `tied`, which holds both of its faces, the end of a beam by a weld; or let it be, if a hinge is meant.",
};

pub(crate) static OPEN_CAVITY: Message = Message {
    code: "E0516",
    title: "a cavity that is not closed",
    example: Example::Model("[[cavity]]\nname = \"gap\"\non = [\"block.right\", \"wall.left\"]\nambient = \"100 kPa\"\n"),
    cause: "Gas has a volume only in a closed surface. Rims are closed by what has its nodes at the same places, by planes of \
        symmetry, and by the axis of an axisymmetric model.",
    remedy: "Name all sides that look into the gas; add the missing walls as parts, or `[[symmetry]]` where the model is a part of the body.",
};

pub(crate) static WRONG_SIDE: Message = Message {
    code: "E0517",
    title: "a cavity seen from outside",
    example: Example::Model("[[cavity]]\nname = \"gas\"\non = \"block\"\nambient = \"100 kPa\"\n"),
    cause: "The surface encloses the bodies instead of the gas, or nothing: the volume that it looks into is not positive.",
    remedy: "Name the inner sides of the walls: of a ring `ring.inner`, of a shell the side that looks into the gas.",
};

pub(crate) static SPEED: Message = Message {
    code: "W0502",
    title: "a speed that no body has",
    example: Example::Model(
        "[[part]]\nname = \"block\"\nmaterial = \"steel\"\nvelocity = [\"100 km/s\", 0]\nrectangle = { corner = [0, 0], size = [\"10 mm\", \"10 mm\"], elements = [2, 2] }\n\n\
         [[contact]]\nname = \"self\"\nbodies = \"all\"\n",
    ),
    cause: "A body moves at more than 20 km/s, without an equation of state: guns reach a tenth, and no solid bears what it meets then.",
    remedy: "Look at the unit of the velocity: a number without one is in m/s. Of what is that fast, give the material an equation of state.",
};

pub(crate) static FALLING: Message = Message {
    code: "W0503",
    title: "gravity on bodies that nothing holds",
    example: Example::Model(
        "[[part]]\nname = \"block\"\nmaterial = \"steel\"\nrectangle = { corner = [0, 0], size = [\"10 mm\", \"10 mm\"], elements = [2, 2] }\n\n\
         [[load]]\ngravity = [0, \"-9.81 m/s^2\"]\n\n[[contact]]\nname = \"self\"\nbodies = \"all\"\n",
    ),
    cause: "Gravity without a curve is the only load, no body moves at the start, and there is no constraint, obstacle, symmetry, spring or \
        joint with the ground: all fall freely, and nothing is strained.",
    remedy: "Hold the bodies by a [[constraint]], or let them lie on an [[obstacle]].",
};
