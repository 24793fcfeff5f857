#include "tests/gl/spied_gl.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <sstream>
#include <type_traits>
#include <utility>

namespace gnomon {
namespace {

/// Calls recorded, and how to undo the spying: C's function pointers cannot carry them.
std::vector<std::string> calls;
std::vector<void (*)()> undo;

template <class Value>
void write(std::ostream& text, Value value) {
    if constexpr (std::is_pointer_v<Value>)
        text << '*';
    else
        text << +value;
}

template <auto Slot>
struct Spy;
template <class R, class... A, R (**Slot)(A...)>
struct Spy<Slot> {
    static inline R (*driver)(A...) = nullptr;
    static inline const char* name = nullptr;

    static void put(const char* function) {
        name = function;
        driver = *Slot;
        *Slot = &call;
        undo.push_back([] { *Slot = driver; });
    }
    static R call(A... arguments) {
        std::ostringstream text;
        [[maybe_unused]] const char* separator = "";
        text << name << '(';
        ((text << std::exchange(separator, ", "), write(text, arguments)), ...);
        text << ')';
        calls.push_back(text.str());
        *Slot = driver;  // the loader's own function puts the driver's into the table when it is called
        const struct Again {
            ~Again() { driver = std::exchange(*Slot, &call); }
        } again;
        return driver(arguments...);
    }
};

}  // namespace

// Every function that engine/gl calls. A test compares the list with the sources.
#define GNOMON_SPIED(X)                            \
    X(ActiveTexture)                               \
    X(AttachShader)                                \
    X(BeginQuery)                                  \
    X(BindBuffer)                                  \
    X(BindBufferBase)                              \
    X(BindBufferRange)                             \
    X(BindBuffersBase)                             \
    X(BindBuffersRange)                            \
    X(BindFramebuffer)                             \
    X(BindSampler)                                 \
    X(BindSamplers)                                \
    X(BindTexture)                                 \
    X(BindTextureUnit)                             \
    X(BindTextures)                                \
    X(BindVertexArray)                             \
    X(BlendEquation)                               \
    X(BlendEquationSeparatei)                      \
    X(BlendFunc)                                   \
    X(BlendFuncSeparate)                           \
    X(BlendFuncSeparatei)                          \
    X(BlitNamedFramebuffer)                        \
    X(CheckNamedFramebufferStatus)                 \
    X(ClearBufferfv)                               \
    X(ClearBufferuiv)                              \
    X(ClearNamedBufferData)                        \
    X(ClearNamedBufferSubData)                     \
    X(ClientWaitSync)                              \
    X(ClipControl)                                 \
    X(ColorMask)                                   \
    X(ColorMaski)                                  \
    X(CompileShader)                               \
    X(CopyImageSubData)                            \
    X(CopyNamedBufferSubData)                      \
    X(CreateBuffers)                               \
    X(CreateFramebuffers)                          \
    X(CreateProgram)                               \
    X(CreateQueries)                               \
    X(CreateSamplers)                              \
    X(CreateShader)                                \
    X(CreateTextures)                              \
    X(CreateVertexArrays)                          \
    X(CullFace)                                    \
    X(DebugMessageCallback)                        \
    X(DeleteBuffers)                               \
    X(DeleteFramebuffers)                          \
    X(DeleteProgram)                               \
    X(DeleteQueries)                               \
    X(DeleteSamplers)                              \
    X(DeleteShader)                                \
    X(DeleteSync)                                  \
    X(DeleteTextures)                              \
    X(DeleteVertexArrays)                          \
    X(DepthFunc)                                   \
    X(DepthMask)                                   \
    X(DepthRange)                                  \
    X(DepthRangeIndexed)                           \
    X(DepthRangef)                                 \
    X(DetachShader)                                \
    X(Disable)                                     \
    X(Disablei)                                    \
    X(DispatchCompute)                             \
    X(DrawArrays)                                  \
    X(DrawElementsInstancedBaseVertexBaseInstance) \
    X(Enable)                                      \
    X(EnableVertexArrayAttrib)                     \
    X(Enablei)                                     \
    X(EndQuery)                                    \
    X(FlushMappedNamedBufferRange)                 \
    X(FenceSync)                                   \
    X(Finish)                                      \
    X(FrontFace)                                   \
    X(GenTextures)                                 \
    X(GenerateTextureMipmap)                       \
    X(GetActiveUniform)                            \
    X(GetBooleani_v)                               \
    X(GetBooleanv)                                 \
    X(GetDoublei_v)                                \
    X(GetError)                                    \
    X(GetFloati_v)                                 \
    X(GetFloatv)                                   \
    X(GetGraphicsResetStatus)                      \
    X(GetInteger64i_v)                             \
    X(GetInteger64v)                               \
    X(GetIntegeri_v)                               \
    X(GetIntegerv)                                 \
    X(GetMultisamplefv)                            \
    X(GetNamedBufferParameteri64v)                 \
    X(GetNamedBufferParameteriv)                   \
    X(GetNamedBufferSubData)                       \
    X(GetPointerv)                                 \
    X(GetProgramInfoLog)                           \
    X(GetProgramInterfaceiv)                       \
    X(GetProgramPipelineiv)                        \
    X(GetProgramResourceiv)                        \
    X(GetProgramStageiv)                           \
    X(GetProgramiv)                                \
    X(GetQueryObjectui64v)                         \
    X(GetQueryObjectuiv)                           \
    X(GetQueryiv)                                  \
    X(GetShaderInfoLog)                            \
    X(GetShaderiv)                                 \
    X(GetString)                                   \
    X(GetTextureLevelParameteriv)                  \
    X(GetTextureParameteriv)                       \
    X(GetTextureSubImage)                          \
    X(GetUniformLocation)                          \
    X(GetUniformSubroutineuiv)                     \
    X(GetUniformiv)                                \
    X(GetVertexArrayIndexediv)                     \
    X(IsBuffer)                                    \
    X(IsEnabled)                                   \
    X(IsEnabledi)                                  \
    X(IsTexture)                                   \
    X(IsVertexArray)                               \
    X(LineWidth)                                   \
    X(LinkProgram)                                 \
    X(MemoryBarrier)                               \
    X(NamedBufferData)                             \
    X(MapNamedBufferRange)                         \
    X(MultiDrawElementsIndirect)                   \
    X(NamedBufferStorage)                          \
    X(NamedBufferSubData)                          \
    X(NamedFramebufferDrawBuffers)                 \
    X(NamedFramebufferReadBuffer)                  \
    X(NamedFramebufferTexture)                     \
    X(NamedFramebufferTextureLayer)                \
    X(ObjectLabel)                                 \
    X(PauseTransformFeedback)                      \
    X(PixelStorei)                                 \
    X(PolygonMode)                                 \
    X(PopDebugGroup)                               \
    X(ProvokingVertex)                             \
    X(PushDebugGroup)                              \
    X(QueryCounter)                                \
    X(ResumeTransformFeedback)                     \
    X(SamplerParameterf)                           \
    X(SamplerParameterfv)                          \
    X(SamplerParameteri)                           \
    X(Scissor)                                     \
    X(ScissorIndexedv)                             \
    X(ShaderSource)                                \
    X(TextureBuffer)                               \
    X(TextureBufferRange)                          \
    X(TextureParameteri)                           \
    X(TextureStorage2D)                            \
    X(TextureStorage3D)                            \
    X(TextureSubImage2D)                           \
    X(TextureSubImage3D)                           \
    X(TextureView)                                 \
    X(UniformSubroutinesuiv)                       \
    X(UseProgram)                                  \
    X(VertexArrayAttribBinding)                    \
    X(VertexArrayAttribFormat)                     \
    X(VertexArrayAttribIFormat)                    \
    X(VertexArrayBindingDivisor)                   \
    X(VertexArrayElementBuffer)                    \
    X(VertexArrayVertexBuffer)                     \
    X(Viewport)                                    \
    X(ViewportIndexedfv)

SpiedGl::SpiedGl() {
    calls.clear();
#define GNOMON_SPY(name) Spy<&epoxy_gl##name>::put("gl" #name);
    GNOMON_SPIED(GNOMON_SPY)
#undef GNOMON_SPY
}

SpiedGl::~SpiedGl() {
    for (void (*const give_back)() : std::exchange(undo, {})) give_back();
}

std::vector<std::string> SpiedGl::names() {
#define GNOMON_NAME(name) "gl" #name,
    return {GNOMON_SPIED(GNOMON_NAME)};
#undef GNOMON_NAME
}

std::vector<std::string> SpiedGl::take() { return std::exchange(calls, {}); }

std::size_t count_calls(const std::vector<std::string>& all, std::string_view name) {
    return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [&](const std::string& call) {
        return std::string_view(call).substr(0, name.size()) == name;
    }));
}

std::vector<std::string> names_of(const std::vector<std::string>& all) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < all.size();) {
        const std::string name = all[i].substr(0, all[i].find('('));
        std::size_t same = 1;
        while (i + same < all.size() && all[i + same].substr(0, all[i + same].find('(')) == name) ++same;
        names.push_back(same == 1 ? name : name + " x" + std::to_string(same));
        i += same;
    }
    return names;
}

}  // namespace gnomon
