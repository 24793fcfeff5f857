// shadow_visibility(position, normal, error): the fraction of `light` that reaches a point, for any renderer. Include it after row.glsl,
// which names one kind and one filter. What the row is compiled for is said by program_defines() in systems/shadow/frame/shader_key.h;
// SHADOW_VISIBILITY names the file that answers.
// LEAVE_UNDECIDED: the filter says `shadow_undecided` where it would take long.
//   position_ca   from the camera's anchor, metres
//   normal        geometric normal, unit, facing the viewer
//   error_m       how far position_ca may be off the true surface
#include SHADOW_VISIBILITY
