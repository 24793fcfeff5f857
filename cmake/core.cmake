# Gnomon::core: fits, receiver and caster sets, predicted errors, and what other parts need of meshes. Links GLM and nothing
# else, so that an engine on any graphics API can take it. .ci/check_arrows.py reads the list and holds that line; .ci/check_core compiles it with GLM alone.
set(GNOMON_CORE_SOURCES
  engine/gl/device.cpp
  engine/math/aabb.cpp
  engine/math/bounds_tree.cpp
  engine/math/cone.cpp
  engine/math/convex_polygon.cpp
  engine/math/frustum.cpp
  engine/math/inner_hull.cpp
  engine/math/projection.cpp
  engine/math/shape_tree.cpp
  engine/mesh/complete_mesh.cpp
  engine/mesh/deformer.cpp
  engine/mesh/half_edges.cpp
  engine/mesh/mesh_normals.cpp
  engine/mesh/inner_box.cpp
  engine/mesh/mesh_shape.cpp
  engine/mesh/mesh_topology.cpp
  engine/mesh/mesh_weld.cpp
  engine/mesh/proxies/add_proxies.cpp
  engine/mesh/proxies/coarser_surface.cpp
  engine/mesh/proxies/edge_collapse.cpp
  engine/mesh/proxies/surface_distance.cpp
  engine/mesh/proxies/triangle_tree.cpp
  engine/mesh/surface_edges.cpp
  systems/extract/camera_view.cpp
  systems/extract/flat_range.cpp
  systems/extract/light_facts.cpp
  systems/extract/scene_tree.cpp
  systems/extract/source_place.cpp
  systems/extract/usable.cpp
  systems/extract/volumes.cpp
  systems/core/core.cpp
  systems/core/lookup.cpp
  systems/core/results.cpp
  systems/core/scene_input.cpp
  systems/core/status.cpp
  systems/shadow/projection/cascade_splits.cpp
  systems/shadow/projection/cube_faces.cpp
  systems/shadow/projection/depth_range_override.cpp
  systems/shadow/projection/depth_rounding.cpp
  systems/shadow/projection/far_lamp_aim.cpp
  systems/shadow/projection/light_frusta.cpp
  systems/shadow/projection/light_range.cpp
  systems/shadow/projection/orthographic_view.cpp
  systems/shadow/projection/perspective_view.cpp
  systems/shadow/projection/screen_bounds.cpp
  systems/shadow/projection/spot_cube_transition.cpp
  systems/shadow/projection/sun_viewpoint.cpp
  systems/shadow/frame/instance_layers.cpp
  systems/shadow/frame/receiver_caster_sets.cpp
  systems/shadow/request/accuracy_target.cpp
  systems/shadow/request/decide_requests.cpp
  systems/shadow/request/filter_choice.cpp
  systems/shadow/request/filter_settings.cpp
  systems/shadow/request/filter_table.cpp
  systems/shadow/request/light_kinds.cpp
  systems/shadow/request/map_textures.cpp
  systems/shadow/request/triangle_references.cpp
  systems/shadow/request/occluder_pyramid.cpp
  systems/shadow/request/prefilter_settings.cpp
  systems/shadow/request/ray_limit.cpp
  systems/shadow/culling/inner_receivers.cpp
  systems/shadow/culling/nearest_receiver.cpp
  systems/shadow/culling/error_points.cpp
  systems/shadow/culling/lit_areas.cpp
  systems/shadow/culling/occluders.cpp
  systems/shadow/culling/receiver_caster_sets.cpp
  systems/shadow/culling/receiver_hull.cpp
  systems/shadow/culling/receiver_mask.cpp
  systems/shadow/culling/static_dynamic_casters.cpp
  systems/shadow/culling/swept_volume.cpp
  systems/shadow/culling/view_casters.cpp
  systems/shadow/fitting/choose_proxies.cpp
  systems/shadow/fitting/directional/cascade_slices.cpp
  systems/shadow/fitting/directional/caster_depth_range.cpp
  systems/shadow/fitting/directional/fit_directional.cpp
  systems/shadow/fitting/directional/fit_lispsm.cpp
  systems/shadow/fitting/directional/fit_perspective.cpp
  systems/shadow/fitting/directional/fit_quantised.cpp
  systems/shadow/fitting/directional/fit_stable.cpp
  systems/shadow/fitting/directional/fit_tight.cpp
  systems/shadow/fitting/directional/min_area_rectangle.cpp
  systems/shadow/fitting/directional/sdsm_splits.cpp
  systems/shadow/fitting/directional/slice_sphere.cpp
  systems/shadow/fitting/directional/split_transition.cpp
  systems/shadow/fitting/error_bound.cpp
  systems/shadow/fitting/fit_light.cpp
  systems/shadow/fitting/fit_views.cpp
  systems/shadow/fitting/light_space_extents.cpp
  systems/shadow/fitting/local/fit_frustum.cpp
  systems/shadow/fitting/local/fit_hysteresis.cpp
  systems/shadow/fitting/local/fit_point.cpp
  systems/shadow/fitting/local/fit_spot.cpp
  systems/shadow/fitting/local/frustum_content.cpp
  systems/shadow/fitting/static_frames.cpp
)
list(TRANSFORM GNOMON_CORE_SOURCES PREPEND ${PROJECT_SOURCE_DIR}/ OUTPUT_VARIABLE core_paths)
add_library(gnomon_core STATIC ${core_paths})
add_library(Gnomon::core ALIAS gnomon_core)
target_include_directories(gnomon_core PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
  PRIVATE ${PROJECT_SOURCE_DIR})
target_compile_features(gnomon_core PUBLIC cxx_std_20)
target_link_libraries(gnomon_core PUBLIC glm::glm PRIVATE $<BUILD_INTERFACE:gnomon_options>)
gnomon_compiled_alone(
  ${PROJECT_SOURCE_DIR}/systems/extract/light_facts.cpp ${PROJECT_SOURCE_DIR}/systems/extract/source_place.cpp
  ${PROJECT_SOURCE_DIR}/systems/extract/camera_view.cpp ${PROJECT_SOURCE_DIR}/systems/shadow/culling/swept_volume.cpp)
