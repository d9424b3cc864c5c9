//! The map of the Earth: places that are known, areas, and that it joins.

use std::f64::consts::PI;

use kerrscope::texture::Texture;
use kerrscope::texture::earth::{Outlines, Ring, UNITS};
use proptest::prelude::*;

/// Longitude and latitude in degrees.
type Place = (&'static str, [f64; 2]);

/// Places at least 20 km from any shore.
const LAND: [Place; 24] = [
    ("Paris", [2.35, 48.86]),
    ("Madrid", [-3.70, 40.42]),
    ("Moscow", [37.62, 55.76]),
    ("Khartoum", [32.53, 15.60]),
    ("Addis Ababa", [38.75, 9.03]),
    ("Johannesburg", [28.05, -26.20]),
    ("Antananarivo", [47.52, -18.91]),
    ("Tamanrasset", [5.52, 22.79]),
    ("Delhi", [77.21, 28.61]),
    ("Lhasa", [91.11, 29.65]),
    ("Ulan Bator", [106.91, 47.92]),
    ("Yakutsk", [129.73, 62.03]),
    ("Alice Springs", [133.88, -23.70]),
    ("Denver", [-104.99, 39.74]),
    ("Mexico City", [-99.13, 19.43]),
    ("Fairbanks", [-147.72, 64.84]),
    ("Winnipeg", [-97.14, 49.90]),
    ("Bogota", [-74.07, 4.71]),
    ("Brasilia", [-47.88, -15.79]),
    ("La Paz", [-68.15, -16.50]),
    ("Summit Camp, Greenland", [-38.46, 72.58]),
    ("Chukotka, on the meridian of 180°", [180.0, 68.0]),
    ("the same from the other side", [-180.0, 68.0]),
    ("the south pole", [0.0, -90.0]),
];

/// Places in the sea, at least 20 km from any shore; without ice on the map.
const SEA: [Place; 22] = [
    ("0° N, 0° E", [0.0, 0.0]),
    ("the Challenger Deep", [142.2, 11.35]),
    ("Point Nemo", [-123.39, -48.88]),
    ("the Titanic's wreck", [-49.95, 41.73]),
    ("the middle of the Bay of Biscay", [-5.0, 45.5]),
    ("the middle of the North Sea", [3.0, 56.5]),
    ("the Gotland Basin of the Baltic", [20.0, 57.3]),
    ("the Tyrrhenian Sea", [12.0, 40.0]),
    ("the Levantine Sea", [30.0, 33.5]),
    ("the middle of the Black Sea", [34.0, 43.2]),
    ("the middle of the Red Sea", [38.0, 20.5]),
    ("the middle of the Persian Gulf", [51.5, 27.0]),
    ("the Arabian Sea", [63.0, 15.0]),
    ("the Bay of Bengal", [88.0, 14.0]),
    ("the South China Sea", [114.0, 15.0]),
    ("the Sea of Japan", [135.0, 40.0]),
    ("the Tasman Sea", [160.0, -38.0]),
    ("the Gulf of Mexico", [-90.0, 25.0]),
    ("the Caribbean Sea", [-75.0, 15.0]),
    ("the middle of Hudson Bay", [-85.0, 60.0]),
    ("the Mozambique Channel", [41.0, -18.0]),
    ("the Drake Passage", [-65.0, -59.0]),
];

/// Middles of lakes; the first is a sea within the outlines of land.
const LAKES: [Place; 8] = [
    ("the Caspian Sea", [51.0, 42.0]),
    ("Lake Superior", [-87.5, 47.7]),
    ("Lake Michigan", [-87.0, 43.5]),
    ("Lake Huron", [-82.3, 44.8]),
    ("Lake Victoria", [33.0, -1.2]),
    ("Lake Baikal", [108.3, 53.6]),
    ("Lake Ladoga", [31.4, 60.8]),
    ("Great Bear Lake", [-121.0, 66.0]),
];

fn color(map: &Texture, [longitude, latitude]: [f64; 2]) -> [f64; 3] {
    map.sample(0.5 + longitude / 360.0, 0.5 - latitude / 180.0, true).light.rgb
}

#[test]
fn places_are_where_they_are() {
    let (outlines, map) = (Outlines::built_in(), Texture::earth());
    for (places, dry) in [(&LAND[..], true), (&SEA, false), (&LAKES, false)] {
        for &(name, place) in places {
            assert_eq!(outlines.is_land(place[0], place[1]), dry, "{name}");
            // Water is blue: no ground, and no ice, has as much more blue than red.
            let [red, _, blue] = color(&map, place);
            assert_eq!(blue < 1.5 * red, dry, "{name} {red} {blue}");
        }
    }
    let ice = color(&map, [0.0, 90.0]);
    assert!(!outlines.is_land(0.0, 90.0) && ice.iter().all(|&c| c > 0.5), "the north pole: {ice:?}");
}

/// The share of the sphere's area inside outlines of which an odd number encloses a place.
fn area(rings: &[Ring]) -> f64 {
    let depth = |at: usize| {
        let [x, y] = rings[at].corners[0].map(|x| f64::from(x) / f64::from(UNITS));
        rings.iter().enumerate().filter(|&(k, ring)| k != at && ring.contains(x, y)).count()
    };
    rings.iter().enumerate().map(|(k, ring)| if depth(k) % 2 == 0 { ring.area() } else { -ring.area() }).sum()
}

#[test]
fn areas_are_as_in_books() {
    let outlines = Outlines::built_in();
    // Earth in km²; land with its lakes (The World Factbook), of which ice shelves (Rignot et al. 2013,
    // Science 341, 266), which are no land in these outlines.
    let (earth, land, shelves) = (510.072e6, 148.94e6, 1.561e6);
    let found = area(&outlines.land);
    assert!((found / ((land - shelves) / earth) - 1.0).abs() < 0.01, "{}", found * earth);
    // Single islands in km²: Iceland, Cuba, Greenland (UNEP Island Directory) and Australia's mainland
    // (Geoscience Australia). On a sphere of the Earth's area, areas are off by 0.6 % at most.
    let islands = [
        ([-18.0, 65.0], 101_826.0),
        ([-79.0, 22.0], 105_806.0),
        ([-40.0, 72.0], 2.1308e6),
        ([134.0, -25.0], 7.591608e6),
    ];
    for ([x, y], known) in islands {
        let ring = outlines.land.iter().find(|ring| ring.contains(x, y)).unwrap();
        let found = ring.area() * earth;
        assert!((found / known - 1.0).abs() < 0.01, "{x} {y} {found}");
    }
}

#[test]
fn simple_outlines_have_their_areas() {
    let ring = |corners: &[[i32; 2]]| Ring {
        corners: corners.iter().map(|corner| corner.map(|x| x * UNITS)).collect(),
    };
    // An octant of the sphere: across the meridian of 180°, in either sense.
    let octant = ring(&[[135, 0], [-135, 0], [-135, -90], [135, -90]]);
    let back = Ring { corners: octant.corners.iter().rev().copied().collect() };
    // What lies south of 30° south is a quarter: once around the pole.
    let cap = ring(&[[0, -30], [120, -30], [-120, -30]]);
    for (ring, share) in [(&octant, 0.125), (&back, 0.125), (&cap, 0.25)] {
        assert!((ring.area() - share).abs() < 1e-15, "{}", ring.area());
    }
    for (place, inside) in [([180.0, -1.0], true), ([-170.0, -89.0], true), ([0.0, -1.0], false)] {
        let [x, y] = place;
        assert_eq!([octant.contains(x, y), back.contains(x, y)], [inside; 2], "{place:?}");
    }
    assert!(cap.contains(17.0, -31.0) && cap.contains(-160.0, -90.0) && !cap.contains(17.0, -29.0));
}

#[test]
fn outlines_are_whole_and_damage_is_found() {
    let outlines = Outlines::built_in();
    assert_eq!([outlines.land.len(), outlines.lakes.len()], [1419, 320]);
    let mut bytes = outlines.encode();
    assert_eq!(Outlines::decode(&bytes), Some(outlines));
    bytes.push(0);
    assert_eq!(Outlines::decode(&bytes), None);
    // Cut short at any place; where a number of outlines is too large to be true.
    let few = Outlines {
        land: vec![Ring { corners: vec![[-17_999, 8999], [17_999, -9000], [5, 0]] }],
        lakes: vec![],
    };
    let bytes = few.encode();
    assert_eq!(Outlines::decode(&bytes), Some(few));
    for length in 0..bytes.len() {
        assert_eq!(Outlines::decode(&bytes[..length]), None, "{length}");
    }
    assert_eq!(Outlines::decode(&[255; 8]), None);
    assert_eq!(Outlines::decode(&[255, 255, 255, 255, 255, 255, 255, 127]), None);
}

#[test]
fn it_joins_at_the_edges_and_at_the_poles() {
    let map = Texture::earth();
    let [width, height] = [map.width(), map.height()];
    assert_eq!([width, height], [4096, 2048]);
    let pixel = |x: u32, y: u32| {
        let [u, v] = [(x, width), (y, height)].map(|(at, size)| (f64::from(at) + 0.5) / f64::from(size));
        map.sample(u, v, false).light.rgb
    };
    let apart = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| (a[k] - b[k]).abs()).sum::<f64>();
    // How much neighbours in a row differ, in the mean: at the edges no more than elsewhere.
    let step = |x: u32| {
        let sum: f64 = (0..height).map(|y| apart(pixel(x, y), pixel((x + 1) % width, y))).sum();
        sum / f64::from(height)
    };
    let largest = (0..32).map(|k| step(127 * k)).fold(0.0, f64::max);
    assert!(step(width - 1) <= largest, "{} {largest}", step(width - 1));
    // A row of pixels at a pole is 5 km wide.
    for y in [0, height - 1] {
        let far = (0..width).map(|x| apart(pixel(x, y), pixel(0, y))).fold(0.0, f64::max);
        assert!(far < 0.01, "{y} {far}");
    }
}

#[test]
fn the_same_for_any_number_of_threads() {
    let [one, three] = [1, 3].map(|threads| {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(Texture::earth)
    });
    assert_eq!(one, three);
}

#[test]
fn light_is_that_of_the_earth() {
    // The mean over the sphere of the share of light that the ground returns. Of 184 W/m² that reach it, 23
    // are returned (Trenberth, Fasullo & Kiehl 2009, Bull. Amer. Meteor. Soc. 90, 311); snow of the seasons
    // is part of them. A drawing is right when it is neither below half nor above twice of that.
    let map = Texture::earth();
    let (mut sum, mut weight) = (0.0, 0.0);
    for y in 0..128 {
        let latitude = 90.0 - 180.0 * (f64::from(y) + 0.5) / 128.0;
        for x in 0..256 {
            let [r, g, b] = color(&map, [360.0 * (f64::from(x) + 0.5) / 256.0 - 180.0, latitude]);
            let area = (PI * latitude / 180.0).cos();
            sum += area * (0.2126 * r + 0.7152 * g + 0.0722 * b);
            weight += area;
        }
    }
    let mean = sum / weight;
    assert!((0.5..2.0).contains(&(mean / (23.0 / 184.0))), "{mean}");
}

proptest! {
    #[test]
    fn no_bytes_do_harm(bytes in prop::collection::vec(any::<u8>(), 0..64)) {
        if let Some(outlines) = Outlines::decode(&bytes) {
            prop_assert_eq!(Outlines::decode(&outlines.encode()), Some(outlines));
        }
    }
}
