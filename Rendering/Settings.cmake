# The settings of vtkSVORenderPass, and the figures that it tells of its last frame, each in one place. From here follow its properties and what it prints
# (vtkSVOPassSettings), the tracer's settings (svoTracerSettings.h), which of them are compared from frame to frame
# and agreed on by processes, ParaView's properties of a view, and the tables of Documentation/Guide.md, section 4.
# CMake/vtkSVOSettings.cmake makes them; a new setting is an entry here, and the code that acts by it.
#
# vtksvo_setting(<name> bool|int|double|vector|memory|choice <default>
#   TABLE    speed, shadows, time or host: the guide's table
#   RANGE    <least> <most>, of numbers; values beyond become the nearest one. Memory is in KiB
#   UNIT     of numbers, for people
#   CHOICES  <enumerator> <name>..., of choices, by their values from 0
#   FIELD    its name in svo::TracerSettings, where the tracer acts by it; of memory, in bytes
#   TYPE     of that field, of choices: an enumeration, which is made of them (SHADOW_BUFFER: Buffer)
#   CHANGES  rays, shadows or look: what is traced or shaded anew when it changes. nothing: no picture shows it, it is
#            not compared
#   AGREED   processes that share a scene's shadow maps take the first one's
#   PANEL    default or advanced: of ParaView's views, in this order
#   PARAVIEW <default of ParaView's views, where it is another one>
#   WIDGET   of ParaView's panels
#   LABEL    in ParaView, where it is not the name's words
#   SAYS     sentences for whoever looks at the setting: ParaView's help, and the first ones of the manuals
#   MORE     further ones of the manuals: what it costs, why the default is what it is)
#
# vtksvo_statistic(<name> double|int|vtkIdType|memory
#   OF       its name in svo::PassStatistics, of memory in bytes. Without, vtkSVORenderPass has the method
#   UNIT     of numbers, for people
#   PARAVIEW a view has it
#   SAYS     what it is)

vtksvo_setting(ShadowTechnique choice SHADOW_BUFFER
  TABLE shadows
  CHOICES SHADOW_NONE None SHADOW_BUFFER ShadowBuffer SHADOW_RAYS ShadowRays SHADOW_AUTOMATIC Automatic
    SHADOW_VOLUMES ShadowVolumes
  FIELD shadowTechnique TYPE ShadowTechnique CHANGES shadows
  PANEL default
  SAYS
    "How shadows are found: not at all, by a shadow buffer per light that is traced like the picture itself, or by one
     ray from each visible point to each light, which is exact. Automatic takes buffers, wherever the data lies, and rays
     with the OpenGL backend, if a GPU has them as fast as the CPU. Shadow volumes are as exact as rays: OpenGL draws them, in
     frames that it makes, from the edges between what of a caster faces the light and what does not. (A point behind exactly 128 surfaces counts as lit.)"
  MORE
    "Where everything moves a frame with rays takes 1.5 times one with buffers (ten objects of 17 000 triangles, 2.6
     times of 1.1 million each, 0.7 times in small windows with few objects of millions). Where little moves buffers are
     quicker, since they are kept, and so are buffers where leaves are no triangles. Rasterised surfaces receive from
     buffers in either case. `GetNumberOfLightsWithShadowRays()` says what was done.")

vtksvo_setting(ShadowIntensity double 1
  TABLE shadows RANGE 0 1
  FIELD shadowIntensity CHANGES look
  PANEL default PARAVIEW 0.7
  SAYS
    "Share of a light's diffuse and specular part that a shadow takes. Ambient light stays. 1: shadows of a single light
     are black."
  MORE
    "That is the paper's black.")

vtksvo_setting(TranslucentShadows bool true
  TABLE shadows
  PANEL default
  SAYS
    "Translucent surfaces cast shadows as light as they are: by opacity, of surfaces and of blocks, and by colours with
     opacity mapping. Off: they cast none."
  MORE
    "Each such surface takes from a ray of light the share of its opacity where the ray meets it first, so that a closed
     body counts once and opacities of 0 and 1 are what invisible and opaque surfaces are. Several surfaces multiply what
     they leave. `SetCastShadow(true, prop)` has all of a surface cast like an opaque one. The alpha of textures does not
     count. Off, a message says what casts nothing.")

vtksvo_setting(FilterShadows bool false
  TABLE shadows
  FIELD filterShadows CHANGES look
  PANEL default
  SAYS
    "Smooth edges of shadows: buffers are filtered, so that their texels show no steps, however few they are, on traced and
     on rasterised surfaces. Pictures take up to twice as long."
  MORE
    "A point gets a share of each light, from all texels around it, compared with the planes of its surface. Only with
     `AutomaticShadowBias`, and not with exact rays. Where all is shaded anew a frame takes 1.4 to 2.1 times as long (with
     `AntiAliasing` 2.3 to 5.6), which is why it is not on by default.")

vtksvo_setting(AmbientOcclusion bool false
  TABLE shadows
  FIELD ambientOcclusion CHANGES look
  PANEL default
  SAYS
    "Darken places that other surfaces close off, as corners, folds and what lies under something, whatever the lights: by
     rays over the hemisphere of each visible point."
  MORE
    "It needs no light set up. What translucent surfaces take is their opacity. The rays of a pixel are
     `MaximumLightSamples`.")

vtksvo_setting(AmbientOcclusionDistance double 0
  TABLE shadows RANGE 0 1e30 UNIT "world units"
  FIELD ambientOcclusionDistance CHANGES look
  PANEL advanced
  SAYS
    "Surfaces farther away from a point close nothing off. 0: a fifth of the diagonal of all that casts shadows.")

vtksvo_setting(AmbientOcclusionStrength double 1
  TABLE shadows RANGE 0 1
  FIELD ambientOcclusionStrength CHANGES look
  PANEL advanced
  SAYS
    "Share of the light that a point loses whose hemisphere is closed all around.")

vtksvo_setting(AmbientOcclusionOfAllLight bool true
  TABLE shadows
  FIELD ambientOcclusionOfAllLight CHANGES look
  PANEL advanced
  SAYS
    "Ambient occlusion darkens all light. Off: only the ambient part of materials, which is none in most scenes.")

vtksvo_setting(SkyLight bool false
  TABLE shadows
  FIELD skyLight CHANGES look
  PANEL default
  SAYS
    "Light that comes from all of the sky: each visible point gets what it sees of it."
  MORE
    "It is diffuse light, beside that of all lights, and casts the softest of shadows, by rays over the hemisphere of
     each point (`MaximumLightSamples`). A white surface under nothing but a white sky is white. Lights that are to
     have no part in it are to be switched off; VTK's automatic headlight is one of them.")

vtksvo_setting(SkyFromEnvironment bool false
  TABLE shadows
  PANEL advanced
  SAYS
    "The sky's light is that of the view's environment texture, an equirectangular image, instead of the two colours."
  MORE
    "`SetEnvironmentTexture()` of the renderer, turned as `SetEnvironmentUp()` and `SetEnvironmentRight()` say; of floats, or
     of bytes, which are linear unless the texture says that they are sRGB. Directions are drawn as often as light comes
     from them, so a small sun in it casts sharp shadows. Larger images are averaged to 128 by 64 cells. Physically based surfaces with
     VTK's image-based lighting have that.")

vtksvo_setting(SkyColor vector "0.75, 0.87, 1"
  TABLE shadows UNIT "colour"
  FIELD skyColor CHANGES look
  PANEL advanced WIDGET color_selector
  SAYS
    "Colour of the sky overhead. Between it and `GroundColor` it goes by the cosine to `SkyUp`.")

vtksvo_setting(GroundColor vector "0.35, 0.33, 0.3"
  TABLE shadows UNIT "colour"
  FIELD groundColor CHANGES look
  PANEL advanced WIDGET color_selector
  SAYS
    "Colour that comes from below.")

vtksvo_setting(SkyUp vector "0, 0, 1"
  TABLE shadows UNIT "direction"
  FIELD skyUp CHANGES look
  PANEL advanced
  SAYS
    "Where the sky is overhead. Of any length; 0 0 0: all of it is of the two colours' mean.")

vtksvo_setting(SkyStrength double 1
  TABLE shadows RANGE 0 1000
  FIELD skyStrength CHANGES look
  PANEL advanced
  SAYS
    "Times the sky's colours, or its picture.")

vtksvo_setting(MaximumLightSamples int 32
  TABLE shadows RANGE 1 4096 UNIT "a pixel"
  FIELD lightSamples CHANGES look
  PANEL default
  SAYS
    "Rays from each visible point to each light that has a size (`SetLightSize`), and over its hemisphere for ambient
     occlusion. Fewer leave grain, more take longer. While you interact there are 4 at most,
     and one where there is nothing but what is around and samples are filtered."
  MORE
    "Off screen, and in windows without an interactor, so many are taken before `Render()` returns. With one a still picture
     begins with as few; while the interactor has nothing else to do it gets twice as many, again and again, or (without
     `LightError`) as many more as take half a second. `Refine()` takes twice as many, for scripts. `GetNumberOfLightSamples()` tells how many it has.
     Where the pass is set on the renderer, and ProgressEvent or the window's AbortCheckEvent has an observer, samples are taken in such steps, too: the
     former is invoked between them, and an observer that sets the window's AbortRender leaves it at those that there are. The next
     `Render()` takes the others.")

vtksvo_setting(FilterLightSamples bool true
  TABLE shadows
  FIELD filterLightSamples CHANGES look
  PANEL advanced
  SAYS
    "Take the samples of the surface around a pixel for it as well, as far as what is seen of a light does not change there:
     grain of few samples goes away."
  MORE
    "Up to eight pixels around, with about the same normal and in about the same plane. The more samples
     there are the less is taken from around. What lets light through in finer patterns than chance tells apart gets
     blurred. At a picture's border there is less around, so where a screenshot is put together from tiles (`SetScale`) these
     may differ by a few of 255 along their seams: switch it off there and take more samples.")

vtksvo_setting(LightError double 0
  TABLE shadows RANGE 0 255 UNIT "of 255"
  PANEL advanced
  SAYS
    "Stop sampling lights where twice as many samples have changed the picture by no more than this (root of the mean
     square, of colours up to 255). 0: take all of `MaximumLightSamples`."
  MORE
    "What VTK draws counts by its shares of light, which the OpenGL backend reads back for it.")

vtksvo_setting(AntiAliasing bool false
  TABLE speed
  FIELD antiAliasing CHANGES look
  PANEL default LABEL "Anti-Aliasing"
  SAYS
    "Smooth edges inside and between traced surfaces, and those of shadows, which are filtered, with four rays in each of
     their pixels."
  MORE
    "It filters shadows as `FilterShadows` does, whether that is on or off. Silhouettes and edges between facets follow the
     render window's own multisampling (`SetMultiSamples`), as those of everything that VTK draws. With
     OpenGL it does no more than to filter shadow maps.")

vtksvo_setting(ShadowBufferResolution int 2048
  TABLE shadows RANGE 16 16384 UNIT texels
  FIELD shadowResolution CHANGES shadows AGREED
  PANEL default
  SAYS
    "Texels along an edge of one shadow map. A directional or spot light has one map. A point light has one where its
     casters subtend less than 120 degrees, else the six faces of a cube."
  MORE
    "Where the texels of such a map would look wider than 4 pixels, as close to an object, on terrain or on a large ground
     that casts, the light's maps are fitted to what is seen instead: one, and up to five finer ones inside of it for what
     is near. Where the maps of all lights would take more than `ShadowMemoryLimit` they have half as many texels along an
     edge, and so on.")

vtksvo_setting(PixelError double 1
  TABLE speed RANGE 0 64 UNIT pixels
  FIELD pixelError CHANGES rays AGREED
  PANEL default
  SAYS
    "Speed against accuracy: rays stop at the octree level whose voxels look no larger than this. 0: always the full depth."
  MORE
    "Triangles that look larger than about a pixel are traced exactly anyway, which is faster still. So are smaller ones, up
     to about 64 in a voxel of that size, with shadows and without. Only meshes finer than that show what the error allows:
     outlines fatter by up to as much, with the normals of their rims.")

vtksvo_setting(AutomaticShadowBias bool true
  TABLE shadows
  FIELD automaticBias CHANGES shadows
  PANEL advanced
  SAYS
    "Compare depths on the plane of the receiving surface, so that no surface shades itself."
  MORE
    "Each at the texel's own ray (Dou et al., JCGT 2014).")

vtksvo_setting(ShadowBias double 0
  TABLE shadows RANGE 0 1000 UNIT "voxels of the caster"
  FIELD bias CHANGES shadows
  PANEL advanced
  SAYS
    "Added to the depth of a shadow map, in voxels of the caster."
  MORE
    "With `AutomaticShadowBias` off, 0 is the paper's bare `distance > depth`.")

vtksvo_setting(AutoAdjustSampleDistances bool true
  TABLE speed
  PANEL advanced
  SAYS
    "While you interact, keep rays as far apart as the time for a frame asks, up to `MaximumImageSampleDistance`. Still
     pictures have a ray for each pixel."
  MORE
    "The window says that you interact: its desired update rate is 1 Hz or more. The pass keeps to half of a frame's time,
     which all renderers of the window with a pass share, with rays equally far apart. Shadow maps of camera lights, which
     are traced in every frame, get coarser first, by at most as much, and rays follow where that does not save enough.
     `GetImageSampleDistance()` and `GetAcceptedPixelError()` say what it came to. Other frames do not depend on the time
     that anything takes. Named as in vtkGPUVolumeRayCastMapper.")

vtksvo_setting(MaximumImageSampleDistance double 8
  TABLE speed RANGE 1 64 UNIT pixels
  PANEL advanced
  SAYS
    "Largest distance from ray to ray while you interact.")

vtksvo_setting(DetailCullingThreshold double 0
  TABLE time RANGE 0 1e6 UNIT pixels
  PANEL advanced
  SAYS
    "While you interact, objects whose rectangle has fewer pixels than this are not drawn. They still cast. Still pictures
     have all of them."
  MORE
    "0: all are drawn. `GetAcceptedPixelError()` says how long the edges of what was left out were,
     `GetNumberOfCulledInstances(step)` how many there were.")

vtksvo_setting(LayerMemoryLimit memory 524288
  TABLE time
  FIELD layerMemoryLimit CHANGES nothing
  PANEL advanced
  SAYS
    "Memory for what is kept of each traced object until it or the viewpoint changes (`FrameCoherence`).")

vtksvo_setting(ShadowMemoryLimit memory 4194304
  TABLE time
  FIELD shadowMemoryLimit CHANGES shadows
  PANEL advanced
  SAYS
    "Memory for the shadow buffers of all lights together, with the copies for rasterised surfaces. Where they would take
     more they have fewer texels."
  MORE
    "It counts tiles of 8x8 texels that casters lie in and somebody may look up, of opaque casters and of groups of
     translucent ones, and where rasterised surfaces receive shadows their copies, OpenGL's included. Where the casters'
     boxes tell that it may become more, all maps have half as many texels along an edge, or a quarter, and so on, sixteen
     at least, and a message says so once. `GetShadowMemorySize()` tells what they take.")

vtksvo_setting(OctreeMemoryLimit memory 1048576
  TABLE time
  PANEL advanced
  SAYS
    "Memory for octrees that the pass builds itself. Those that the picture does not need go first."
  MORE
    "So the poses of an animated mesh are built once as long as they fit. Of a loop that is longer as many are kept as there
     is room for. Octrees of meshes that are deleted go at once. What a single frame needs is kept in any case, with a
     warning where that is more. Passes of one process share octrees of the same mesh. `ReleaseOctrees()` frees all.")

vtksvo_setting(MaximumLevel int 10
  TABLE speed RANGE 1 20
  SAYS
    "Level of the deepest octrees that the pass builds: 2^level voxels along an edge of the mesh's cube."
  MORE
    "They are built no deeper than `PixelError` asks for, by the pixels of the picture and by the texels of the shadow
     buffers, and are deepened when the camera comes closer. With a `PixelError` of 0, and for exact shadow rays, all are of
     this level. One more: half the voxel, about four times the memory and build time.")

vtksvo_setting(LeafGeometry choice LEAF_AUTOMATIC
  TABLE speed
  CHOICES LEAF_VOXEL Voxel LEAF_PLANE Plane LEAF_TRIANGLE Triangle LEAF_AUTOMATIC Automatic
  SAYS
    "What a ray meets in a leaf of octrees that the pass builds: the cube, the plane of a triangle in it (both as coarse as
     the voxels, so unfit for what is long and thin), or the triangles themselves (exact, and fastest where they look larger
     than about a pixel)."
  MORE
    "Automatic takes triangles where they look larger than about a pixel, or where 4 x 4 x 4 voxels have at most 64 of them,
     and planes where they are more. See vtkPolyDataToSVO.")

vtksvo_setting(ConvertPolyData bool true
  TABLE speed
  SAYS
    "Build an octree for each surface that comes without one. Off: only meshes that went through `vtkPolyDataToSVO` are
     traced and cast shadows.")

vtksvo_setting(FrameCoherence bool true
  TABLE time
  FIELD frameCoherence CHANGES nothing
  SAYS
    "Keep what was traced of an object until its matrix, octree, level of detail or viewpoint changes. Where nothing at all
     has changed, show the picture once more. The picture is the same either way."
  MORE
    "As everywhere in VTK, who writes into an array calls its `Modified()`.")

vtksvo_setting(ViewCulling bool true
  TABLE time
  FIELD viewCulling CHANGES nothing
  SAYS
    "Find instances that lie outside of a view together, by a loose octree of all of them, instead of one by one. The picture
     is the same to the bit.")

vtksvo_setting(OcclusionCulling bool true
  TABLE time
  FIELD occlusionCulling CHANGES nothing
  SAYS
    "Leave out instances that others hide before they are traced, and of shadow volumes casters whose shadows fall on
     nothing that is seen. The picture is the same to the bit.")

vtksvo_setting(BuildInBackground bool true
  TABLE time
  SAYS
    "While you interact, build octrees in the background. Meanwhile a coarser or deeper octree of the surface is traced if
     there is one, else it is rasterised. A still picture waits for them."
  MORE
    "The window says that you interact: its desired update rate is 1 Hz or more. While a still render waits it invokes
     ProgressEvent, and its picture depends neither on time nor on what was shown before. An observer of it, or of the
     window's AbortCheckEvent, that sets the window's AbortRender ends the wait: surfaces whose octrees are not there yet are
     left to the rasteriser, of which VTK shows as much as of any frame that is aborted.")

vtksvo_setting(Backend choice BACKEND_AUTO
  TABLE time
  CHOICES BACKEND_AUTO Auto BACKEND_CPU CPU BACKEND_OPENGL OpenGL
  PANEL advanced
  SAYS
    "Where the picture is made. CPU: octrees are traced on the processor. OpenGL: VTK draws all surfaces itself, or its
     shaders trace those without triangles; shadow maps are drawn by OpenGL, exact rays to each light follow the octrees in
     its shaders. Auto: OpenGL on a GPU, with ShadowRays, ambient occlusion or a sky on one that answers rays as fast as the
     CPU; else, and where there are several processes, the CPU."
  MORE
    "Rays are measured once for each OpenGL context, in its first frame that asks for them. Software OpenGL takes the CPU, and
     so do
     scenes in which VTK would show a contour of surfaces without triangles: of parts of assemblies, and of those that share
     a prop with meshes. OpenGL knows no PixelError of them: it always stops at the octree's voxels.
     `GetActiveBackend()` says what the last frame took. The rule has been tried on software OpenGL only.")

vtksvo_setting(GPUMemoryLimit memory 2097152
  TABLE time
  FIELD gpuMemoryLimit CHANGES nothing
  PANEL advanced LABEL "GPU Memory Limit (KiB)"
  SAYS
    "Octrees in the GPU's memory, with the OpenGL backend, and shadow maps, or a picture of the light on what is seen. What
     does not fit is answered by shadow maps of the CPU, with a message; without room for the picture a frame takes longer.
     Renderers of a window share octrees; where those of all do not fit they are sent in each frame.")

vtksvo_setting(ShadowsForEverything bool false
  TABLE host
  PANEL first
  SAYS
    "All surfaces of this view are traced, cast shadows and receive them, as if they were shown as SVO. What cannot be traced
     (edges, textures, translucent surfaces, glyphs' lines and more) is drawn as ever and receives. Molecules, lines as tubes
     and points as spheres cast as well, and so do Point Gaussians that are opaque discs. Off: this is so of surfaces that
     are shown as SVO. Octrees are built when they are first needed."
  MORE
    "To programs: of attached renderers. Shown as SVO is what has an explicit `SetUseSVO(true, prop)`. The pass builds the
     others' octrees, and gives no messages about them: `GetReasonInLastFrame()` says what of them casts nothing. Where the
     pass is set on a renderer all surfaces are traced in any case.")

vtksvo_setting(Tracing bool true
  TABLE host
  SAYS
    "Off: frames of attached renderers are left to the rasteriser, for a host that needs the mesh's own depth, as a selection
     of points does. It is asked at the renderer's StartEvent, after observers of priority 0.")

vtksvo_setting(ImageReductionFactor int 1
  TABLE host RANGE 1 50
  SAYS
    "For a host that enlarges what it renders, as ParaView's servers do while the user interacts: how many pixels of the
     window a pixel of the frame becomes, along an edge."
  MORE
    "`MaximumImageSampleDistance` holds in the window. Named as in vtkSynchronizedRenderers.")

vtksvo_statistic(ActiveBackend int OF "openGL ? BACKEND_OPENGL : BACKEND_CPU" PARAVIEW
  SAYS "The backend that the last frame took: BACKEND_CPU (1), also before the first, or BACKEND_OPENGL (2).")
vtksvo_statistic(CollectTime double OF collectTime UNIT s PARAVIEW
  SAYS "Seconds that the last frame took to find what there is to trace, octrees that had to be built included; these
    times are the clock's.")
vtksvo_statistic(TraceTime double OF tracer.traceTime UNIT s PARAVIEW
  SAYS "Seconds that the last frame took to trace and shade.")
vtksvo_statistic(ShadowTime double OF tracer.shadowTime UNIT s PARAVIEW
  SAYS "Seconds that the last frame took for shadow buffers or rays.")
vtksvo_statistic(PresentTime double OF presentTime UNIT s PARAVIEW
  SAYS "Seconds that the last frame took to hand the picture to OpenGL.")
vtksvo_statistic(NumberOfPrimaryRays vtkIdType OF tracer.primaryRays PARAVIEW
  SAYS "Rays from the eye in the last frame.")
vtksvo_statistic(NumberOfShadowRays vtkIdType OF tracer.shadowRays PARAVIEW
  SAYS "Rays to lights, and texels from lights, in the last frame.")
vtksvo_statistic(NumberOfLightSamples int OF tracer.lightSamples PARAVIEW
  SAYS "Samples a pixel, of each light that has a size and of ambient occlusion, that the last frame shows; 0 without
    such lights.")
vtksvo_statistic(NumberOfRetracedLayers vtkIdType OF tracer.retracedLayers PARAVIEW
  SAYS "Objects, seen from the eye or a light, that the last frame traced or drew anew.")
vtksvo_statistic(NumberOfLightsWithShadowBuffers int OF tracer.lightsWithBuffers
  SAYS "Casting lights of the last frame whose shadows were found by buffers.")
vtksvo_statistic(NumberOfLightsWithShadowRays int OF tracer.lightsWithRays
  SAYS "Casting lights of the last frame whose shadows were found by rays.")
vtksvo_statistic(NumberOfShadowVolumes vtkIdType OF tracer.shadowVolumes
  SAYS "Shadow volumes of the last frame: casters that had one, once for each light.")
vtksvo_statistic(NumberOfContourEdges vtkIdType OF tracer.contourEdges
  SAYS "Edges of casters at which the last frame's shadow volumes begin.")
vtksvo_statistic(NumberOfTracedActors int OF tracedActors PARAVIEW
  SAYS "Surfaces that the last frame traced; parts of assemblies count one by one.")
vtksvo_statistic(NumberOfRasterizedActors int OF rasterizedActors
  SAYS "Visible surfaces that the last frame left to the rasteriser.")
vtksvo_statistic(NumberOfInstances int OF instances PARAVIEW
  SAYS "Octrees in the last frame: one for each block that is traced or casts.")
vtksvo_statistic(LayerMemorySize memory OF tracer.layerMemory PARAVIEW
  SAYS "Memory in KiB of what is kept of traced objects.")
vtksvo_statistic(ShadowMemorySize memory OF "tracer.shadowMemory + frame.receiverMemory" PARAVIEW
  SAYS "Memory in KiB of shadow buffers, with the copies for rasterised surfaces.")
vtksvo_statistic(GPUMemory memory OF tracer.gpuMemory PARAVIEW
  SAYS "Memory in KiB of octrees in the GPU's memory, which the renderers of a window share, and of the pictures from which rays to lights start there.")
vtksvo_statistic(OctreeMemorySize memory PARAVIEW
  SAYS "Memory in KiB of octrees that the view built itself.")
vtksvo_statistic(ImageSampleDistance double OF "sampleDistance()" UNIT pixels PARAVIEW
  SAYS "Pixels of the window from ray to ray in the last frame.")
vtksvo_statistic(AcceptedPixelError double UNIT pixels PARAVIEW
  SAYS "The pixel error that the last frame accepted to save time, in pixels.")
vtksvo_statistic(AcceptedLightError double OF tracer.lightNoise UNIT "of 255" PARAVIEW
  SAYS "How far what samples say of each light, of a sky and of ambient occlusion may be off by chance in the last frame: root
    of the mean square of all pixels, where a whole light is 255. What filtering them blurs is not among it. Negative with
    OpenGL, which does not tell.")
