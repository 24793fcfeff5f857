// Verdicts from here on are places in the list of those that rays decide; below, they are shadow/exact/verdict.glsl's.
const uint kListed = 2u;
