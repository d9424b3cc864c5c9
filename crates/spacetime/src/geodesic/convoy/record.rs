//! Steps in which something happens, kept until there are enough to look into at once.

/// What the dense output of `W` steps needs, lane by lane.
#[derive(Clone, Copy)]
pub struct Record<const D: usize, const STAGES: usize, const W: usize> {
    /// The state before.
    pub y: [[f64; W]; D],
    /// The state after.
    pub end: [[f64; W]; D],
    /// The slopes at the stages.
    pub stages: [[[f64; W]; D]; STAGES],
    /// The slope at the end.
    pub end_slope: [[f64; W]; D],
    /// The step.
    pub h: [f64; W],
    /// −p_t.
    pub energy: [f64; W],
    /// The height above the plane that counts for the start of the step.
    pub above: [f64; W],
    /// Azimuth swept before the step.
    pub swept: [f64; W],
    /// Azimuth by which its ends differ.
    pub turn: [f64; W],
}

impl<const D: usize, const STAGES: usize, const W: usize> Record<D, STAGES, W> {
    /// Nothing yet: a ray at rest, so that empty lanes are harmless.
    pub const EMPTY: Self = Self {
        y: [[1.0; W]; D],
        end: [[1.0; W]; D],
        stages: [[[0.0; W]; D]; STAGES],
        end_slope: [[0.0; W]; D],
        h: [0.0; W],
        energy: [1.0; W],
        above: [1.0; W],
        swept: [0.0; W],
        turn: [0.0; W],
    };

    /// Copies a lane of another record; stages 1 to `spared` are not needed.
    #[inline(always)]
    pub fn copy(&mut self, to: usize, other: &Self, from: usize, spared: usize) {
        for i in 0..D {
            self.y[i][to] = other.y[i][from];
            self.end[i][to] = other.end[i][from];
            self.end_slope[i][to] = other.end_slope[i][from];
            self.stages[0][i][to] = other.stages[0][i][from];
        }
        for stage in 1 + spared..STAGES {
            for i in 0..D {
                self.stages[stage][i][to] = other.stages[stage][i][from];
            }
        }
        self.h[to] = other.h[from];
        self.energy[to] = other.energy[from];
        self.above[to] = other.above[from];
        self.swept[to] = other.swept[from];
        self.turn[to] = other.turn[from];
    }
}
