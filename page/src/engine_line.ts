// The line that names the engine of a page without the program. A page of `cascade view` has no such line, because the
// program computes.

/// `about` is the name of the GPU, or the reason why the engine is not WebGPU.
export function show_engine(name: string, about: string) {
    const line = document.getElementById("engine_in_use")!;
    line.textContent = name === "WebGPU" ? `computes with WebGPU on ${about}` : `computes with ${name}, because ${about}`;
}
