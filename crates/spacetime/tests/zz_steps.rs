mod common;
use common::*;
use kerrscope_spacetime::geodesic::*;
use kerrscope_spacetime::metric::*;
#[test]
fn steps() {
    for tol in [1e-6,1e-10] { for scheme in [Scheme::Tsit5{tolerance:tol}, Scheme::Dop853{tolerance:tol}] {
        let mut rnd = Random::new(1);
        let (mut a, mut b) = (0,0);
        for _ in 0..200 {
            let ray = impact(0.9, 1.0, f64::INFINITY, rnd.within(-12.,12.), rnd.within(-12.,12.));
            let t = Integrator::new(Kerr::new(0.9), scheme, 10000);
            a += follow(&t,&ray,&Query::default()).steps;
            b += follow(&t,&ray,&Query{elapsed:true,..Query::default()}).steps;
        }
        println!("ZZ {scheme:?} {} {}", a as f64/200., b as f64/200.);
    }}
}
