// Takes the place of the shaders' own file where their text is compiled as C++ (shader_structs.inc): instances in double, which no
// texel holds.
StorageBuffer<InstanceRecord> instances;

InstanceRecord instance_record(uint instance) { return instances[instance]; }
