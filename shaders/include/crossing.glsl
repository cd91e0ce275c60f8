// Where a number that is known along a ray changes its sign: regula falsi by the Illinois rule (M. Dowell and P. Jarratt,
// "A Modified Regula Falsi Method for Computing the Root of an Equation", BIT 11, 1971).
struct Crossing {
    float a;  // two places, of which `b` is the newer one
    float b;
    float at_a;  // the number there; the signs differ
    float at_b;
};

float crossing_guess(Crossing crossing) {
    float a = crossing.at_a;
    float b = crossing.at_b;
    return a == b ? crossing.b : crossing.a + (crossing.b - crossing.a) * clamp(a / (a - b), 0.0, 1.0);
}

// The same after the number `now` was found at `place`.
Crossing crossing_closer(Crossing crossing, float place, float now) {
    bool same = (now < 0.0) == (crossing.at_b < 0.0);
    return Crossing(same ? crossing.a : crossing.b, place, same ? 0.5 * crossing.at_a : crossing.at_b, now);
}
