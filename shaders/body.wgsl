// A solid's unit mesh, turned, stretched and put in its place.

struct Solid {
    @location(0) vertex: vec3f,
    @location(1) normal: vec3f,
    // Its axes in the world times its size; in w red, green and blue.
    @location(2) x: vec4f,
    @location(3) y: vec4f,
    @location(4) z: vec4f,
    // Its centre; w: share of the distance by which depth brings it forward.
    @location(5) place: vec4f,
}

// Metres relative to the frame's origin.
fn body_position(in: Solid) -> vec3f {
    return in.place.xyz + in.x.xyz * in.vertex.x + in.y.xyz * in.vertex.y + in.z.xyz * in.vertex.z;
}
