// Takes the place of the shaders' own file where their text is compiled as C++ (shader_structs.inc): layout() says nothing there.
