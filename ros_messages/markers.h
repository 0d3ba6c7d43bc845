// Draws scenes (scene.h) as RViz's markers.
#pragma once

#include "ros_messages/marker_types.h"
#include "ros_messages/scene_types.h"

namespace tern::ros {

/// The width of a line, m. Lines of a scene have theirs in pixels, which RViz does not know.
inline constexpr double kMarkerLineWidth = 0.05;

/// The same shapes as markers. Entities become namespaces. All cubes of an entity are one marker of triangles, and so
/// are its triangles: so a later scene replaces shapes that have gone. A deletion of all entities comes first, as in
/// the scene. Arrows, spheres, cylinders and models are left out; Tern's scenes have none.
MarkerArray markers_of(const SceneUpdate& scene);

}  // namespace tern::ros
