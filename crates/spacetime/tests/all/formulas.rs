//! Formulas: what they mean, what is wrong with broken ones, and that programs work them out.

use kerrscope_spacetime::formula::{Fault, Graph, Names, NodeId, Program, parse};
use kerrscope_spacetime::{Dual, Lanes, Level, OnLanes, Scalar};

/// x, y and z as inputs.
struct Coordinates;

impl Names for Coordinates {
    fn resolve(&mut self, name: &str, graph: &mut Graph) -> Result<Option<NodeId>, (String, String)> {
        Ok(["x", "y", "z", "radius"].iter().position(|known| *known == name).map(|i| graph.input(i as u8)))
    }

    fn known(&self) -> Vec<String> {
        ["x", "y", "z", "radius"].map(str::to_owned).to_vec()
    }
}

fn program(text: &str) -> Program {
    let mut graph = Graph::default();
    let node =
        parse(text, &mut graph, &mut Coordinates).unwrap_or_else(|faults| panic!("{text}: {faults:?}"));
    Program::compile(&graph, 4, &[node]).unwrap()
}

fn value(text: &str, [x, y, z]: [f64; 3]) -> f64 {
    let mut out = [f64::NAN];
    program(text).evaluate(&[x, y, z, 0.0], &mut out);
    out[0]
}

fn faults(text: &str) -> Vec<Fault> {
    parse(text, &mut Graph::default(), &mut Coordinates).unwrap_err()
}

#[test]
fn formulas_mean_what_they_say() {
    let at = [0.7, -1.3, 2.1];
    let [x, y, z] = at;
    let cases: [(&str, f64); 24] = [
        ("1 + 2*3", 7.0),
        ("-x^2", -(x * x)),
        ("(-x)^2", x * x),
        ("2^3^2", 512.0),
        ("x^-2", 1.0 / (x * x)),
        ("z^1.5", z * z.sqrt()),
        ("z^0.3", z.powf(0.3)),
        ("z^x", z.powf(x)),
        ("8/4/2", 1.0),
        ("1 - 2 - 3", -4.0),
        ("x/(y*z) + 1e-3", x / (y * z) + 1e-3),
        ("--x", x),
        ("sqrt(x^2 + y^2)", x.hypot(y)),
        ("atan2(y, x)", y.atan2(x)),
        ("tan(x) + sin(y)*cos(z)", x.tan() + y.sin() * z.cos()),
        ("exp(-x) + ln(z)", (-x).exp() + z.ln()),
        ("sinh(x) + cosh(y)*tanh(z)", x.sinh() + y.cosh() * z.tanh()),
        ("min(x, y) + max(y, z) + abs(y)", y + z - y),
        ("pi*e", std::f64::consts::PI * std::f64::consts::E),
        ("x*0 + y*1 - 0", y),
        ("x/x", 1.0),
        ("y + (-x)", y - x),
        ("2*x*3/y", 6.0 * x / y),
        ("(x + y)*(x + y) - (y + x)^2", 0.0),
    ];
    for (text, expected) in cases {
        let found = value(text, at);
        assert!((found - expected).abs() <= 4e-16 * (1.0 + expected.abs()), "{text}: {found} {expected}");
    }
    assert!(value("ln(x)", [-1.0, 0.0, 0.0]).is_nan());
    assert!((value("sinh(x)", [1e-9, 0.0, 0.0]) / 1e-9 - 1.0).abs() < 1e-15);
    assert_eq!(value("tanh(x)", [1e6, 0.0, 0.0]), 1.0);
}

#[test]
fn equal_parts_are_worked_out_once() {
    assert_eq!(program("(x + y)^2 / ((x + y)^2 + 1)").len(), program("x + y").len() + 4);
    // Numbers are worked out before: x, a factor, the result.
    assert_eq!(program("x * (2 + 3*4 - sqrt(2))").len(), 2);
}

/// Twenty broken formulas, each refused at its place, with the mend.
#[test]
fn broken_formulas_are_refused_at_their_place() {
    let cases: [(&str, usize, &str, &str); 24] = [
        ("", 0, "the formula is empty", "write a number, a name, or brackets"),
        ("2x", 1, "an operator is missing before this", "2*x"),
        ("x y", 2, "an operator is missing before this", "`*`"),
        ("x + ", 4, "a value is missing", "write a number"),
        ("(x + y", 0, "this `(` is never closed", "close it with `)`"),
        ("x + y)", 5, "this `)` closes nothing", "remove it"),
        ("x * / y", 4, "a value is missing before `/`", "write a number"),
        ("sin x", 0, "`sin` is a function", "sin( )"),
        ("sine(x)", 0, "there is no function `sine`", "did you mean sin?"),
        ("log(x)", 0, "there is no function `log`", "did you mean ln?"),
        ("raduis + 1", 0, "`raduis` is not known", "did you mean `radius`?"),
        ("1 + q", 4, "`q` is not known", "known are x, y, z, radius"),
        ("x**2", 1, "`**` has no meaning in a formula", "x^2"),
        ("x²", 1, "`²` has no meaning in a formula", "x^2"),
        ("2·x", 1, "`·` has no meaning in a formula", "`*`"),
        ("0,5*x", 1, "a comma stands between the arguments of a function only", "0.5"),
        ("1.2.3 + x", 0, "`1.2.3` is no number", "0.5"),
        ("atan2(y)", 0, "atan2 has 2 arguments, and here is 1", "atan2(y, x)"),
        ("sqrt(x, y)", 0, "sqrt has 1 argument, and here are 2", "sqrt(x)"),
        ("x(1 + y)", 0, "there is no function `x`", ""),
        ("x/(1 - 1)", 2, "this divides by zero", "correct the divisor"),
        ("[x + y]*2", 0, "`[` has no meaning in a formula", "round"),
        ("x = y", 2, "`=` has no meaning in a formula", "`let`"),
        ("()", 0, "there is nothing between these brackets", "write a value"),
    ];
    for (text, place, what, mend) in cases {
        let faults = faults(text);
        let first = &faults[0];
        assert_eq!(first.span.start, place, "{text}: {faults:?}");
        let what = if text == "x(1 + y)" { "`x` is a value, not a function" } else { what };
        assert!(first.message.contains(what), "{text}: {faults:?}");
        assert!(first.help.contains(mend), "{text}: {faults:?}");
    }
}

#[test]
fn all_unknown_names_are_told_at_once() {
    let found = faults("a + b*x + c(y)");
    let places: Vec<usize> = found.iter().map(|fault| fault.span.start).collect();
    assert_eq!(places, [0, 4, 10], "{found:?}");
}

#[test]
fn formulas_have_limits() {
    let deep = format!("{}x{}", "(".repeat(80), ")".repeat(80));
    assert!(faults(&deep)[0].message.contains("within one another"));
    let signs = format!("{}x", "-".repeat(3000));
    assert!(faults(&signs)[0].message.contains("within one another"));
    let long = format!("x{}", " + x".repeat(2000));
    assert!(faults(&long)[0].message.contains("bytes"));
    let mut graph = Graph::default();
    let mut many = Vec::new();
    for k in 0..200 {
        let text: Vec<String> = (0..60).map(|j| format!("sin({}*x)", j + 100 * k)).collect();
        many.push(parse(&text.join("+"), &mut graph, &mut Coordinates));
    }
    let full = many.into_iter().find_map(Result::err).unwrap();
    assert!(full[0].message.contains("operations"), "{full:?}");
}

/// What a program has in its lanes, as a dual number.
struct OnAllLanes<'a>(&'a Program);

impl OnLanes for OnAllLanes<'_> {
    type Output = [[f64; 8]; 4];

    #[inline(always)]
    fn run<L: fearless_simd::Simd>(self, simd: L) -> Self::Output {
        let x = Lanes::new(simd, std::array::from_fn(|i| 0.3 + 0.2 * i as f64));
        let point = [x, x * 0.5 + 1.0, -x + 3.0];
        let [a, b, c] = Dual::variables(point);
        let mut out = [a];
        self.0.evaluate(&[a, b, c, a], &mut out);
        let [dx, dy, dz] = out[0].gradient;
        [out[0].value, dx, dy, dz].map(Lanes::to_array)
    }
}

#[test]
fn derivatives_on_lanes_are_exact() {
    let text = "sinh(x)*exp(-y/4) + atan2(y, x*z)^2 + ln(z + x^2)*sqrt(y) + cos(x*y)*max(x, 0.1*z) + z^2.3";
    let program = program(text);
    let lanes = Level::best().run(OnAllLanes(&program));
    for lane in 0..8 {
        let x = 0.3 + 0.2 * lane as f64;
        let at = [x, x * 0.5 + 1.0, -x + 3.0];
        assert!((lanes[0][lane] - value(text, at)).abs() < 2e-14);
        for i in 0..3 {
            let h = 1e-3;
            let shifted = |k: f64| {
                let mut at = at;
                at[i] += k * h;
                value(text, at)
            };
            // Of sixth order.
            let slope = (shifted(1.0) - shifted(-1.0)) * 45.0 - (shifted(2.0) - shifted(-2.0)) * 9.0
                + (shifted(3.0) - shifted(-3.0));
            assert!((lanes[1 + i][lane] - slope / (60.0 * h)).abs() < 1e-11, "{i} {lane}");
        }
    }
    assert_eq!(Dual::variable([2.0], 0).lane(0), 2.0);
}
