// Returns the reversed depth of a fragment of a caster. Casters before the near plane lie on it.
float caster_depth() { return clamp(gl_FragCoord.z, 0.0, 1.0); }
