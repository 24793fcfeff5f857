// Cone between a place and a source with a size, as a map shows it. Straight lines stay straight there: it remains a
// cone, and widens with depth.
const float kMostStretch = 2.5;   // C++ twin: systems/shadow/request/occluder_pyramid.h
struct SourceCone {
    bool is_known;
    float radius_m;       // size of a lamp's source as a disk that faces the place
    float texels;         // most of its radius per unit of depth
    float stretch;        // how much longer the way is than its part along the view's axis
    float steepest;       // see ends_of_texel()
    float texel_tan;
    vec2 alpha_beta;      // depth = alpha + beta / distance along the axis; of a lamp
};

// Returns the radius of the disk in the light's middle that hides all of the source from a place at that distance. An area
// light lies in a ball around its middle: the cone that touches the ball holds it. Within the ball there is none.
float facing_radius_m(float distance_m) {
    float radius_m = light.radiance.w;
#if LIGHT_AREA
    float share = radius_m / max(distance_m, 1e-30);
    return radius_m / sqrt(max(1.0 - share * share, 1e-12)) * (1.0 + 1e-5);
#else
    return radius_m;
#endif
}

// Returns the cone to a lamp. The source faces the place. Away from the axis its picture is therefore longer toward it
// by 1 / cos, and its nearer half stands nearer than its middle.
SourceCone lamp_cone(ViewRecord view, vec2 tangent, float z_m) {
    float stretch = sqrt(1.0 + dot(tangent, tangent)), radius_m = facing_radius_m(z_m * stretch);
    float nearer = radius_m * sqrt(max(1.0 - 1.0 / (stretch * stretch), 0.0)) / z_m;
    float wider = stretch / (1.0 - nearer), texel = min(view.axis_u.w, view.axis_v.w);
#if LIGHT_AREA
    wider *= radius_m / light.radiance.w;   // so that kMostStretch bounds all by which the cone is wider
#endif
    vec2 alpha_beta = vec2(view.numeric.z, view.axis_back.w);
    float per_stretch = light.radiance.w / (alpha_beta.y * texel);
    bool is_known = z_m > 0.0 && nearer < 1.0 && wider < kMostStretch;
    return SourceCone(is_known, radius_m, per_stretch * wider, stretch, 1.0 / (per_stretch * kMostStretch), max(view.axis_u.w, view.axis_v.w),
                      alpha_beta);
}

#ifdef SHADOW_CUBE
SourceCone cone_to_lamp(SheetPlace place, vec3 position_ca) {
    ViewRecord view = light.views[0];
    vec3 p = turned_back(position_ca + view.anchor_from_camera.xyz);
    mat3 axes = face_axes(p);
    return lamp_cone(view, vec2(dot(p, axes[0]), dot(p, axes[1])) / largest(p), largest(p));
}
#else
SourceCone cone_to_lamp(SheetPlace place, vec3 position_ca) {
    ViewRecord view = light.views[place.view];
    vec3 p = position_ca + view.anchor_from_camera.xyz;
    float z_m = -dot(p, view.axis_back.xyz);
    return lamp_cone(view, vec2(dot(p, view.axis_u.xyz), dot(p, view.axis_v.xyz)) / z_m, z_m);
}
#endif

SourceCone source_cone(SheetPlace place, vec3 position_ca) {
    if (!kIsSun) return cone_to_lamp(place, position_ca);
    vec2 texels = sun_source_texel(light.views[place.view]);
    float most = max(texels.x, texels.y);
    return SourceCone(true, 0.0, most, 1.0, 1.0 / most, 0.0, vec2(0.0));
}
