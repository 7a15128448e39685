//! Descriptions of vertex buffers, in few words.

use ash::vk;

/// A field at `offset` in the elements of buffer `binding`.
pub const fn field(
    location: u32,
    binding: u32,
    format: vk::Format,
    offset: u32,
) -> vk::VertexInputAttributeDescription {
    vk::VertexInputAttributeDescription { location, binding, format, offset }
}

/// Buffer `binding` with an element of `stride` bytes for each vertex.
pub const fn by_vertex(binding: u32, stride: usize) -> vk::VertexInputBindingDescription {
    buffer(binding, stride, vk::VertexInputRate::VERTEX)
}

/// Buffer `binding` with an element of `stride` bytes for each instance.
pub const fn by_instance(binding: u32, stride: usize) -> vk::VertexInputBindingDescription {
    buffer(binding, stride, vk::VertexInputRate::INSTANCE)
}

const fn buffer(
    binding: u32,
    stride: usize,
    input_rate: vk::VertexInputRate,
) -> vk::VertexInputBindingDescription {
    vk::VertexInputBindingDescription { binding, stride: stride as u32, input_rate }
}
