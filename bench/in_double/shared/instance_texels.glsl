// Takes the place of the shaders' own file where their text is compiled as C++ (exact_shaders.inc): instances in double, which no
// texel holds.
StorageBuffer<InstanceRecord> instances;

InstanceRecord instance_record(uint instance) { return instances[instance]; }
