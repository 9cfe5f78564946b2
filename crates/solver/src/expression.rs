//! Formulas: of the time `t` for curves, such as `2*sin(3*t) + exp(-t)`, and of columns of the history, such
//! as `cfc60(A.ax) - B.ax`.
//!
//! Text comes from the model; a small parser by precedence makes a list of operations for a stack, which is
//! all that is left at run time. Sine, cosine, exponential and logarithm are the project's own: the
//! platform's differ in the last bits from machine to machine.
//!
//! sum = product { (+|-) product }, product = sign { (*|/) sign }, sign = -sign | power, power = atom [ ^
//! sign ], atom = number | variable | pi | name(sum, ...) | (sum)

use crate::angle::cos_sin;
use crate::vocabulary::nearest;
use embate_lanes::math;

/// Deepest nesting of an expression, and most values that wait on the stack.
const DEPTH_MAX: usize = 64;
/// Longest text, bytes.
const LENGTH_MAX: usize = 4096;

/// A formula.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    program: Vec<Operation>,
}

/// What names in a formula may be, besides `pi` and the functions of numbers.
pub trait Words {
    /// The variable at the beginning of a text: how many bytes its name has, and its number.
    fn variable(&self, text: &str) -> Option<(usize, usize)>;
    /// Names of the variables, for messages.
    fn variables(&self) -> Vec<&str>;
    /// Functions of whole series, each with its number of arguments.
    fn functions(&self) -> &[(&'static str, usize)] {
        &[]
    }
}

/// The time `t` alone.
struct Time;

impl Words for Time {
    fn variable(&self, text: &str) -> Option<(usize, usize)> {
        let ends = |c: char| !(c.is_alphanumeric() || c == '_');
        (text.starts_with('t') && text[1..].chars().next().is_none_or(ends)).then_some((1, 0))
    }

    fn variables(&self) -> Vec<&str> {
        vec!["t"]
    }
}

/// What is wrong with a formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wrong {
    /// Where, in characters from 1.
    pub at: usize,
    /// What.
    pub message: String,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Operation {
    Number(f64),
    /// By its number.
    Variable(usize),
    /// A function of series, by its number among [`Words::functions`], and its number of arguments.
    Series(usize, usize),
    Negate,
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    /// One of [`ONE`].
    One(usize),
    /// One of [`TWO`].
    Two(usize),
}

type Unary = fn(f64) -> f64;
type Binary = fn(f64, f64) -> f64;

/// Functions of one number. `step` is 0 below zero, else 1.
const ONE: &[(&str, Unary)] = &[
    ("sin", |x| cos_sin(x)[1]),
    ("cos", |x| cos_sin(x)[0]),
    ("exp", exp),
    ("ln", ln),
    ("sqrt", f64::sqrt),
    ("abs", f64::abs),
    ("step", |x| if x < 0.0 { 0.0 } else { 1.0 }),
];
/// Functions of two or more numbers, from the left.
const TWO: &[(&str, Binary)] = &[("min", |a, b| if b < a { b } else { a }), ("max", |a, b| if b > a { b } else { a })];

impl Expression {
    /// Reads a formula of the time `t`.
    ///
    /// # Errors
    /// The first thing that is wrong, with its place.
    pub fn parse(text: &str) -> Result<Self, Wrong> {
        Self::parse_with(text, &Time)
    }

    /// Reads a formula of other variables, and with functions of series.
    ///
    /// # Errors
    /// The first thing that is wrong, with its place.
    pub fn parse_with(text: &str, words: &dyn Words) -> Result<Self, Wrong> {
        let mut parser = Parser { words, text, at: 0, program: Vec::new(), depth: 0, waiting: 0 };
        if text.len() > LENGTH_MAX {
            return parser.wrong(0, format!("the expression is longer than {LENGTH_MAX} bytes"));
        }
        parser.sum()?;
        match parser.peek() {
            None => Ok(Self { program: parser.program }),
            Some(')') => parser.wrong(parser.at, "this `)` closes nothing"),
            Some(c) if c.is_alphanumeric() || c == '(' => parser.wrong(parser.at, "an operator is missing here, such as `*`"),
            Some(c) => parser.wrong(parser.at, format!("`{c}` is no operator; there are + - * / ^")),
        }
    }

    /// Values of a formula of series, row by row; `call` gives those of a function of series.
    #[must_use]
    pub fn series(&self, rows: usize, variables: &[&[f64]], call: &dyn Fn(usize, Vec<Vec<f64>>) -> Vec<f64>) -> Vec<f64> {
        let mut stack: Vec<Vec<f64>> = Vec::new();
        for operation in &self.program {
            let mut two = |f: fn(f64, f64) -> f64| {
                let (second, first) = (stack.pop().unwrap_or_default(), stack.pop().unwrap_or_default());
                stack.push(first.into_iter().zip(second).map(|(a, b)| f(a, b)).collect());
            };
            match *operation {
                Operation::Add => two(|a, b| a + b),
                Operation::Subtract => two(|a, b| a - b),
                Operation::Multiply => two(|a, b| a * b),
                Operation::Divide => two(|a, b| a / b),
                Operation::Power => two(power),
                Operation::Two(f) => two(TWO[f].1),
                Operation::One(f) => stack.last_mut().into_iter().flatten().for_each(|value| *value = ONE[f].1(*value)),
                Operation::Negate => stack.last_mut().into_iter().flatten().for_each(|value| *value = -*value),
                Operation::Number(value) => stack.push(vec![value; rows]),
                Operation::Variable(index) => stack.push(variables[index].to_vec()),
                Operation::Series(function, takes) => {
                    let arguments = stack.split_off(stack.len().saturating_sub(takes));
                    stack.push(call(function, arguments));
                }
            }
        }
        stack.pop().unwrap_or_default()
    }

    /// Value at `time`, s.
    #[must_use]
    pub fn value(&self, time: f64) -> f64 {
        let mut stack = [0.0; DEPTH_MAX];
        let mut top = 0; // values on the stack; the parser has made sure that they fit
        for operation in &self.program {
            let mut two = |f: fn(f64, f64) -> f64| {
                top -= 1;
                stack[top - 1] = f(stack[top - 1], stack[top]);
            };
            match *operation {
                Operation::Add => two(|a, b| a + b),
                Operation::Subtract => two(|a, b| a - b),
                Operation::Multiply => two(|a, b| a * b),
                Operation::Divide => two(|a, b| a / b),
                Operation::Power => two(power),
                Operation::Two(f) => two(TWO[f].1),
                Operation::One(f) => stack[top - 1] = ONE[f].1(stack[top - 1]),
                Operation::Negate => stack[top - 1] = -stack[top - 1],
                Operation::Number(value) => {
                    stack[top] = value;
                    top += 1;
                }
                Operation::Variable(_) => {
                    stack[top] = time;
                    top += 1;
                }
                // Curves have none.
                Operation::Series(..) => {}
            }
        }
        stack[0]
    }
}

/// e^x, also beyond what is normal.
fn exp(x: f64) -> f64 {
    if x.is_nan() {
        x
    } else if x > 709.0 {
        f64::INFINITY
    } else if x < -708.0 {
        0.0
    } else {
        math::exp(x)
    }
}

/// Natural logarithm; not a number below zero.
fn ln(x: f64) -> f64 {
    if x.is_nan() || x < 0.0 {
        f64::NAN
    } else if x < f64::MIN_POSITIVE {
        if x == 0.0 { f64::NEG_INFINITY } else { math::ln(x * 18_014_398_509_481_984.0) - 54.0 * std::f64::consts::LN_2 }
    } else if x == f64::INFINITY {
        x
    } else {
        math::ln(x)
    }
}

/// x^y: by products for whole y, else e^{y ln x}.
fn power(x: f64, y: f64) -> f64 {
    if y.fract() != 0.0 || y.abs() > 1024.0 {
        return if x == 0.0 && y > 0.0 { 0.0 } else { exp(y * ln(x)) };
    }
    let (mut rest, mut square, mut product) = (y.abs() as u32, x, 1.0);
    while rest > 0 {
        if rest & 1 == 1 {
            product *= square;
        }
        square *= square;
        rest >>= 1;
    }
    if y < 0.0 { 1.0 / product } else { product }
}

struct Parser<'a> {
    words: &'a dyn Words,
    text: &'a str,
    /// Byte of the text.
    at: usize,
    program: Vec<Operation>,
    depth: usize,
    /// Values on the stack at this place.
    waiting: usize,
}

impl Parser<'_> {
    fn wrong<T>(&self, byte: usize, message: impl Into<String>) -> Result<T, Wrong> {
        Err(Wrong { at: self.text.get(..byte).map_or(0, |before| before.chars().count()) + 1, message: message.into() })
    }

    /// The next character that is no blank.
    fn peek(&mut self) -> Option<char> {
        let rest = &self.text[self.at..];
        let blank = rest.len() - rest.trim_start().len();
        self.at += blank;
        self.text[self.at..].chars().next()
    }

    fn next_is(&mut self, wanted: char) -> bool {
        let found = self.peek() == Some(wanted);
        if found {
            self.at += wanted.len_utf8();
        }
        found
    }

    /// Adds an operation that takes `takes` values and leaves one.
    fn add(&mut self, operation: Operation, takes: usize) -> Result<(), Wrong> {
        self.waiting = self.waiting + 1 - takes;
        if self.waiting > DEPTH_MAX {
            return self.wrong(self.at, format!("the expression is nested more than {DEPTH_MAX} deep"));
        }
        self.program.push(operation);
        Ok(())
    }

    fn sum(&mut self) -> Result<(), Wrong> {
        self.product()?;
        loop {
            let operation = match self.peek() {
                Some('+') => Operation::Add,
                Some('-') => Operation::Subtract,
                _ => return Ok(()),
            };
            self.at += 1;
            self.product()?;
            self.add(operation, 2)?;
        }
    }

    fn product(&mut self) -> Result<(), Wrong> {
        self.sign()?;
        loop {
            let operation = match self.peek() {
                Some('*') => Operation::Multiply,
                Some('/') => Operation::Divide,
                _ => return Ok(()),
            };
            self.at += 1;
            if operation == Operation::Multiply && self.text[self.at..].starts_with('*') {
                return self.wrong(self.at, "write ^ for a power");
            }
            self.sign()?;
            self.add(operation, 2)?;
        }
    }

    fn sign(&mut self) -> Result<(), Wrong> {
        self.depth += 1;
        if self.depth > DEPTH_MAX {
            return self.wrong(self.at, format!("the expression is nested more than {DEPTH_MAX} deep"));
        }
        if self.next_is('-') {
            self.sign()?;
            self.add(Operation::Negate, 1)?;
        } else {
            self.atom()?;
            if self.next_is('^') {
                self.sign()?;
                self.add(Operation::Power, 2)?;
            }
        }
        self.depth -= 1;
        Ok(())
    }

    fn atom(&mut self) -> Result<(), Wrong> {
        match self.peek() {
            None => self.wrong(self.at, "the expression ends where a number, `t` or a function must follow"),
            Some('(') => {
                let open = self.at;
                self.at += 1;
                self.sum()?;
                self.close(open)
            }
            Some(c) if c.is_ascii_digit() || c == '.' => self.number(),
            Some(c) if c.is_alphabetic() => self.name(),
            Some(c) => self.wrong(self.at, format!("`{c}` stands where a number, `t` or a function must be")),
        }
    }

    /// The parenthesis after the name of a function; gives its place.
    fn open(&mut self, name: &str) -> Result<usize, Wrong> {
        let open = self.at;
        if self.next_is('(') { Ok(open) } else { self.wrong(self.at, format!("`{name}` needs its argument in parentheses")) }
    }

    fn close(&mut self, open: usize) -> Result<(), Wrong> {
        if self.next_is(')') {
            return Ok(());
        }
        match self.peek() {
            None => self.wrong(open, "this `(` is never closed"),
            Some(c) => self.wrong(self.at, format!("`{c}` stands where an operator or `)` must be")),
        }
    }

    fn number(&mut self) -> Result<(), Wrong> {
        let (start, bytes) = (self.at, self.text.as_bytes());
        let digits = |mut at: usize| {
            while bytes.get(at).is_some_and(|b| b.is_ascii_digit() || *b == b'.') {
                at += 1;
            }
            at
        };
        let mut end = digits(start);
        if matches!(bytes.get(end), Some(b'e' | b'E')) {
            let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
            if bytes.get(end + 1 + sign).is_some_and(u8::is_ascii_digit) {
                end = digits(end + 1 + sign);
            }
        }
        let written = &self.text[start..end];
        match written.parse::<f64>() {
            Ok(value) if value.is_finite() => {
                self.at = end;
                self.add(Operation::Number(value), 0)
            }
            _ => self.wrong(start, format!("`{written}` is not a number")),
        }
    }

    fn name(&mut self) -> Result<(), Wrong> {
        let start = self.at;
        let rest = &self.text[start..];
        if let Some((length, index)) = self.words.variable(rest) {
            self.at += length;
            return self.add(Operation::Variable(index), 0);
        }
        let name = &rest[..rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len())];
        self.at += name.len();
        if name == "pi" {
            return self.add(Operation::Number(std::f64::consts::PI), 0);
        }
        if let Some(index) = self.words.functions().iter().position(|(known, _)| *known == name) {
            return self.call_series(name, index, start);
        }
        let one = ONE.iter().position(|(known, _)| *known == name);
        let two = TWO.iter().position(|(known, _)| *known == name);
        if one.is_none() && two.is_none() {
            return self.unknown(start, rest);
        }
        let open = self.open(name)?;
        self.sum()?;
        if let Some(f) = one {
            self.close(open)?;
            return self.add(Operation::One(f), 1);
        }
        let mut count = 1;
        while self.next_is(',') {
            self.sum()?;
            count += 1;
            if let Some(f) = two {
                self.add(Operation::Two(f), 2)?;
            }
        }
        self.close(open)?;
        if count < 2 { self.wrong(start, format!("`{name}` needs two or more arguments, divided by commas")) } else { Ok(()) }
    }

    /// A function of series, with as many arguments as it takes.
    fn call_series(&mut self, name: &str, index: usize, start: usize) -> Result<(), Wrong> {
        let (open, takes) = (self.open(name)?, self.words.functions()[index].1);
        let mut count = 1;
        self.sum()?;
        while self.next_is(',') {
            self.sum()?;
            count += 1;
        }
        self.close(open)?;
        if count != takes {
            return self.wrong(start, format!("`{name}` takes {takes} argument(s), not {count}"));
        }
        self.add(Operation::Series(index, takes), takes)
    }

    /// A name that means nothing: of many variables those that are like it.
    fn unknown(&self, start: usize, rest: &str) -> Result<(), Wrong> {
        let end = rest.find(|c: char| !(c.is_alphanumeric() || "_.[]:".contains(c))).unwrap_or(rest.len());
        let (name, variables) = (&rest[..end], self.words.variables());
        if let Some(near) = nearest(name, variables.iter().copied()).filter(|_| variables.len() > 1) {
            return self.wrong(start, format!("there is no `{name}`; did you mean `{near}`?"));
        }
        let functions = ONE.iter().map(|(name, _)| *name).chain(TWO.iter().map(|(name, _)| *name));
        let functions = functions.chain(self.words.functions().iter().map(|(name, _)| *name));
        let known = if variables.len() == 1 { variables[0] } else { "columns of the history" };
        self.wrong(start, format!("there is no `{name}`; there are {known}, pi, {}", functions.collect::<Vec<_>>().join(", ")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(text: &str, time: f64) -> f64 {
        Expression::parse(text).unwrap_or_else(|wrong| panic!("{text}: {wrong:?}")).value(time)
    }

    #[test]
    fn formulas_mean_what_mathematics_means() {
        for (text, value) in [
            ("1 + 2*3", 7.0),
            ("(1 + 2)*3", 9.0),
            ("7 - 2 - 3", 2.0),
            ("8/4/2", 1.0),
            ("-2^2", -4.0),
            ("2^-2", 0.25),
            ("2^3^2", 512.0),
            ("--3", 3.0),
            ("3*-2", -6.0),
            ("1.5e-1 + .5E+1", 5.15),
            ("t^2 - t", 2.0),
            ("max(1, t, -4) - min(t, 1)", 1.0),
            ("step(t - 2) + step(t - 2.5)", 1.0),
            ("abs(-3)*sqrt(16)", 12.0),
            ("0^0.5 + 0^2", 0.0),
            ("t", 2.0),
        ] {
            assert!((at(text, 2.0) - value).abs() <= 1e-15 * value.abs(), "{text}: {} instead of {value}", at(text, 2.0));
        }
    }

    #[test]
    fn functions_agree_with_the_platforms() {
        let t: f64 = 0.7;
        let cases = [
            ("2*sin(3*t)*exp(-t/2) + cos(pi*t)^3", 2.0 * (3.0 * t).sin() * (-0.5 * t).exp() + (std::f64::consts::PI * t).cos().powi(3)),
            ("ln(1 + t)/t^1.7", (1.0 + t).ln() / t.powf(1.7)),
            ("ln(1e-310)", 1e-310_f64.ln()),
        ];
        for (text, value) in cases {
            assert!((at(text, t) / value - 1.0).abs() < 4e-15, "{text}: {} {value}", at(text, t));
        }
        assert!(at("ln(-1)", 0.0).is_nan() && at("(-2)^0.5", 0.0).is_nan() && at("sqrt(-1)", 0.0).is_nan());
        assert_eq!((at("exp(1000)", 0.0), at("exp(-1000)", 0.0), at("ln(0)", 0.0)), (f64::INFINITY, 0.0, f64::NEG_INFINITY));
        assert_eq!((at("1/0", 0.0), at("(-2)^3", 0.0)), (f64::INFINITY, -8.0));
    }

    #[test]
    fn what_is_wrong_is_reported_with_its_place() {
        for (text, place, says) in [
            ("", 1, "ends where"),
            ("1 +", 4, "ends where"),
            ("2t", 2, "operator is missing"),
            ("sin t", 5, "in parentheses"),
            ("2*(t + 1", 3, "never closed"),
            ("t + 1)", 6, "closes nothing"),
            ("2**t", 3, "write ^"),
            ("tan(t)", 1, "there is no `tan`; there are t, pi, sin"),
            ("1 + T", 5, "there is no `T`"),
            ("min(t)", 1, "two or more"),
            ("sin(t, 2)", 6, "`,` stands where"),
            ("1.2.3", 1, "is not a number"),
            ("1e999", 1, "is not a number"),
            ("5 % 2", 3, "`%` is no operator"),
            ("* 3", 1, "`*` stands where"),
            ("π*t", 1, "there is no `π`"),
            ("1 + \u{1f600}", 5, "stands where"),
        ] {
            let wrong = Expression::parse(text).expect_err(text);
            assert!(wrong.at == place && wrong.message.contains(says), "{text}: {wrong:?}");
        }
        for deep in ["(".repeat(100_000), "-".repeat(4000), format!("{}1{}", "1+(".repeat(1000), ")".repeat(1000)), "2^".repeat(2000)] {
            assert!(Expression::parse(&deep).is_err());
        }
        assert!(Expression::parse(&format!("{}t", "1 + ".repeat(1000))).is_ok());
    }
}
