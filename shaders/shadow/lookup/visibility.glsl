// shadow_visibility(position, normal, error): the fraction of `light` that reaches a point, for any renderer. It is
// included after row.glsl, which names one kind and one filter. program_defines() in systems/shadow/frame/shader_key.h
// lists the defines of a row. SHADOW_VISIBILITY names the file that defines the function.
// LEAVE_UNDECIDED: the filter sets `shadow_undecided` where it would take long.
// position_ca: from the camera's anchor, metres.
// normal: geometric normal, unit, facing the viewer.
// error_m: how far position_ca may be off the true surface, metres.
#include SHADOW_VISIBILITY
