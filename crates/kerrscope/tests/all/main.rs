//! All tests from outside in one program: built and linked once, and run side by side.

mod adaptive;
mod chart;
mod chart_scale;
mod checkpoint;
mod colormap;
mod common;
mod disk;
mod display;
mod earth;
mod einstein_ring;
mod exr;
mod fuzz;
mod gyoto;
mod line;
mod measure_features;
mod measure_picture;
mod metric_faults;
mod objects_curved;
mod objects_flat;
mod objects_lens;
// Tests here use a part of it.
#[allow(dead_code)]
#[path = "../../../spacetime/tests/all/common/orbit.rs"]
mod orbit;
mod output;
mod output_file;
mod physical_disk;
mod scene_conflicts;
mod scene_coordinates;
mod scene_faults;
mod scene_keys;
mod scene_limits;
mod scene_objects;
mod scene_overrides;
mod scene_round_trip;
mod scene_sky;
mod science;
mod sky;
mod sky_footprint;
mod sky_panorama;
mod sky_stars;
mod text_curvature;
mod text_disk;
mod text_objects;
mod text_rays;
mod texts;
mod texture;
mod texture_formats;
mod texture_sphere;
mod thesis_series;
