// Replaces the shaders' own file where their text is compiled as C++ (shader_structs.inc): layout() has no effect there.
