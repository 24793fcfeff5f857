// Numbers by which C++ and the shaders name the same thing. C++ twin: shaders/bindings.h, which the build makes of this file.
// Programs that are never bound at once may share a number. A test allows no number beside these.

// Uniform blocks.
const int kCameraBlock = 0;
const int kLightBlock = 1;
const int kMaterialBlock = 2;
const int kFogBlock = 2;          // passes over the picture have no material
const int kAmbientBlock = 3;
const int kExposureBlock = 4;
const int kShownScaleBlock = 5;
const int kKeptBlock = 6;
const int kImportBlock = 7;
const int kSampleBlock = 0;         // passes over the finished picture
const int kDepthViewBlock = 0;    // passes that draw maps: they and the next two passes have no camera
const int kPrefilterBlock = 0;
const int kPyramidBlock = 0;
const int kTransmissionBlock = 3;   // passes that draw translucent casters
const int kFlatViewBlock = 0;     // debug views of maps

// Storage buffers.
const int kExposureBuffer = 0;
const int kDepthBinBuffer = 0;
const int kLineBuffer = 0;
const int kRayListBuffer = 1;
const int kPyramidBuffer = 2;
const int kTintBuffer = 3;
const int kAreaTableBuffer = 4;
const int kMaskBuffer = 7;

// Texture units of surfaces as they are drawn.
const int kBaseColourUnit = 0;
const int kColourUnit = 3;           // a colour per vertex, as texels: a unit that passes over meshes leave free
const int kVertexUnit = 9;           // vertices of all meshes, as texels
const int kInstanceUnit = 14;        // above all that maps and rays use
const int kTriangleNormalUnit = 15;

// Texture units of surfaces as they are read.
const int kSurfaceDepthUnit = 0;
const int kSurfaceColourUnit = 1;
const int kSurfaceNormalUnit = 2;
const int kSurfaceMaterialUnit = 3;
const int kSurfacePlaceUnit = 6;

// Texture units of a light.
const int kShadowMapUnit = 4;
const int kShownTriangleUnit = 5;    // triangle that each texel of the map shows
const int kSecondDepthUnit = 7;      // depths behind those of the map, from other triangles
const int kBoundsUnit = 8;           // nearest contour and departure of each texel of the map
const int kCasterTriangleUnit = 9;
const int kRayNodeUnit = 10;
const int kRayTriangleUnit = 11;
const int kRayTopUnit = 12;
const int kRayInstanceUnit = 13;
const int kTintDepthUnit = 7;        // layers of translucent casters: lights with rays, which need no map of them, use 7 and 8
const int kTintUnit = 8;
const int kVerdictUnit = 5;          // verdict per pixel, found before the light is added
const int kAnswerUnit = 7;
const int kKeptVisibilityUnit = 4;

// Texture units of passes that draw maps.
const int kNearestTriangleUnit = 0;
const int kPeeledDepthUnit = 4;       // and the next three: depths of translucent layers
const int kPrefilterSourceUnit = 0;
const int kBoundsItemUnit = 12;
const int kBoundsVertexUnit = 13;

// Texture units of passes over the picture.
const int kMeteredDepthUnit = 0;
const int kMeteredPictureUnit = 1;
const int kPictureUnit = 0;
const int kLuminanceUnit = 1;
const int kPictureDepthUnit = 2;
const int kCaughtLightUnit = 0;
const int kFinishedPictureUnit = 0;   // passes over the picture as a display shows it

// Texture units of another renderer's picture.
const int kImportedDepthUnit = 0;
const int kImportedNormalUnit = 1;

// Texture units of debug views.
const int kFlatMapsUnit = 0;
const int kCubeMapUnit = 1;

// Vertex attributes. C++ twins: engine/gl/commands.h.
const int kPositionAttribute = 0;
const int kNormalAttribute = 1;
const int kUvAttribute = 2;
const int kDrawItemAttribute = 3;

// From stage to stage of passes that draw casters or surfaces. Every varying of a program has a location, or none has.
// NVIDIA gives the others locations that are taken, and refuses to link.
const int kItemVarying = 0;
const int kUvVarying = 1;
const int kColourVarying = 2;
const int kPositionVarying = 3;
const int kNormalVarying = 4;
const int kCornerVarying = 5;
