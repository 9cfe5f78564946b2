//! A section of the model file from one text: the struct of its values, its description and its reader.

/// Makes a struct, the `static` [`Section`](crate::vocabulary::Section) that describes its table in the model
/// file, its function `read` and its `Default`, which is what is read of a table without keys:
///
/// ```text
/// section! {
///     /// `[[probe]]`: what is recorded.
///     #[derive(Clone, Debug, PartialEq)]
///     pub struct Probe in PROBE = Section { name: "probe", doc: "What is recorded.", ..Section::EMPTY };
///     weight: f64 = Quantity(Dimension::NONE, Positive), Default("1"), "Weight of its values.";
///     from: Option<f64> = Quantity(Dimension::TIME, NotNegative), Optional("the start"), "First time.";
///     mirror: [bool; 3] = Kind::Choices(AXES), Optional("none"), "Axes along which it is mirrored.",
///         read axes;
///     "node" = Integer(0), Required, "Number of its node.";
///     /// Where it is.
///     at: Place, read Place::read;
/// }
/// ```
///
/// An entry is `field: type = kind, need, explanation;`. The explanation is also the documentation of the
/// field, and the type says how the value is read ([`Field`](super::values::Field)), unless a function of the
/// whole table follows after `read`. A key that is no field has its name in quotes and no type; a field that
/// is no key has its documentation, type and function alone.
macro_rules! section {
    ($(#[$own:meta])* pub struct $Type:ident in $SECTION:ident = $description:expr; $($entries:tt)*) => {
        $crate::model::section! { @ ($(#[$own])* $Type $SECTION $description) values [] [] [] $($entries)* }
    };

    // A key that is read as its type says.
    (@ $head:tt $values:ident [$($keys:tt)*] [$($fields:tt)*] [$($read:tt)*]
        $(#[$more:meta])* $field:ident: $type:ty = $kind:expr, $need:ident $(($left_out:literal))?, $doc:literal; $($rest:tt)*
    ) => {
        $crate::model::section! { @ $head $values
            [$($keys)* $crate::vocabulary::key(stringify!($field), $kind, $crate::vocabulary::Need::$need $(($left_out))?, $doc),]
            [$($fields)* #[doc = concat!($doc $(, " Left out: ", $left_out, ".")?)] $(#[$more])* pub $field: $type,]
            [$($read)* $field: $values.get(stringify!($field)),]
            $($rest)*
        }
    };

    // A key with its own reader.
    (@ $head:tt $values:ident [$($keys:tt)*] [$($fields:tt)*] [$($read:tt)*]
        $(#[$more:meta])* $field:ident: $type:ty = $kind:expr, $need:ident $(($left_out:literal))?, $doc:literal, read $by:expr; $($rest:tt)*
    ) => {
        $crate::model::section! { @ $head $values
            [$($keys)* $crate::vocabulary::key(stringify!($field), $kind, $crate::vocabulary::Need::$need $(($left_out))?, $doc),]
            [$($fields)* #[doc = concat!($doc $(, " Left out: ", $left_out, ".")?)] $(#[$more])* pub $field: $type,]
            [$($read)* $field: { let by: fn(&dyn $crate::model::Values) -> $type = $by; by($values) },]
            $($rest)*
        }
    };

    // A key whose value goes elsewhere.
    (@ $head:tt $values:ident [$($keys:tt)*] $fields:tt $read:tt
        $name:literal = $kind:expr, $need:ident $(($left_out:literal))?, $doc:literal; $($rest:tt)*
    ) => {
        $crate::model::section! { @ $head $values
            [$($keys)* $crate::vocabulary::key($name, $kind, $crate::vocabulary::Need::$need $(($left_out))?, $doc),]
            $fields $read $($rest)*
        }
    };

    // A field without a key of its own.
    (@ $head:tt $values:ident $keys:tt [$($fields:tt)*] [$($read:tt)*]
        $(#[$more:meta])* $field:ident: $type:ty, read $by:expr; $($rest:tt)*
    ) => {
        $crate::model::section! { @ $head $values $keys
            [$($fields)* $(#[$more])* pub $field: $type,]
            [$($read)* $field: { let by: fn(&dyn $crate::model::Values) -> $type = $by; by($values) },]
            $($rest)*
        }
    };

    (@ ($(#[$own:meta])* $Type:ident $SECTION:ident $description:expr) $values:ident [$($keys:tt)*] [$($fields:tt)*] [$($read:tt)*]) => {
        $(#[$own])*
        ///
        /// Numbers are in SI units.
        pub struct $Type { $($fields)* }

        pub(crate) static $SECTION: $crate::vocabulary::Section = $crate::vocabulary::Section { keys: &[$($keys)*], ..$description };

        impl $Type {
            /// From its table in the model file.
            #[must_use]
            pub fn read($values: &dyn $crate::model::Values) -> Self {
                Self { $($read)* }
            }
        }

        impl Default for $Type {
            /// The defaults of its keys; zero or nothing where a key has none.
            fn default() -> Self {
                Self::read(&$crate::model::values::LeftOut::of($SECTION.all_keys()))
            }
        }

        impl $crate::model::values::Field for $Type {
            fn sound(values: &dyn $crate::model::Values, key: &str) -> Option<Self> {
                values.table(key).map(Self::read)
            }

            fn placeholder() -> Self {
                Self::default()
            }
        }

        impl $crate::model::values::Field for Vec<$Type> {
            fn sound(values: &dyn $crate::model::Values, key: &str) -> Option<Self> {
                Some(values.list(key)?.into_iter().map($Type::read).collect())
            }

            fn placeholder() -> Self {
                Self::new()
            }
        }
    };
}

pub(crate) use section;
