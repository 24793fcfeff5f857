# Writes OUT, a C++ file with the table of FILES (relative to ROOT) as raw strings.
set(text "#include \"shaders/embedded.h\"\n\nnamespace gnomon {\nnamespace {\nusing namespace std::string_view_literals;\nconstexpr gl::ShaderFile kFiles[] = {\n")
foreach(file IN LISTS FILES)
  file(READ ${ROOT}/${file} content)
  string(APPEND text "    {\"${file}\", R\"glsl(${content})glsl\"sv},\n")  # sv: compilers count a million steps at most
endforeach()
string(APPEND text "};\n}  // namespace\n\nstd::span<const gl::ShaderFile> shader_files() { return kFiles; }\n\n}  // namespace gnomon\n")
file(WRITE ${OUT} "${text}")
