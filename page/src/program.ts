// A program of two shaders. Attributes have the same locations in all programs.

/// The attributes in the order of their locations. Attributes after `before` belong to copies of a mesh.
export const attributes = ["position", "normal", "value", "sky", "before", "spot", "turn", "stretch", "shade"];

export class Program {
    readonly handle: WebGLProgram;
    constructor(private readonly gl: WebGL2RenderingContext, texts: [string, string], kept: string[] = []) {
        this.handle = gl.createProgram()!;
        [gl.VERTEX_SHADER, gl.FRAGMENT_SHADER].forEach((type, k) => {
            const shader = gl.createShader(type)!;
            gl.shaderSource(shader, texts[k]);
            gl.compileShader(shader);
            if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) throw new Error(gl.getShaderInfoLog(shader) ?? "");
            gl.attachShader(this.handle, shader);
        });
        attributes.forEach((name, k) => gl.bindAttribLocation(this.handle, k, name));
        if (kept.length > 0) gl.transformFeedbackVaryings(this.handle, kept, gl.SEPARATE_ATTRIBS);
        gl.linkProgram(this.handle);
        if (!gl.getProgramParameter(this.handle, gl.LINK_STATUS) && !gl.isContextLost()) throw new Error(gl.getProgramInfoLog(this.handle) ?? "");
    }

    /// Uses the program and sets numbers, vectors and matrices by name. Textures have unit 0.
    use(uniforms: Record<string, number | number[] | Float32Array>) {
        const gl = this.gl;
        gl.useProgram(this.handle);
        for (const [name, value] of Object.entries(uniforms)) {
            const at = gl.getUniformLocation(this.handle, name);
            if (typeof value === "number") gl.uniform1f(at, value);
            else if (value.length === 16) gl.uniformMatrix4fv(at, false, value);
            else gl.uniform3fv(at, value);
        }
    }
    whole(name: string, value: number) { this.gl.uniform1i(this.gl.getUniformLocation(this.handle, name), value); }
}
