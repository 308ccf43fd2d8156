/*! Cascade. This file contains CodeMirror, Lezer, uPlot and uqr, under the following license.

MIT License

Copyright (C) 2018-2021 by Marijn Haverbeke <marijn@haverbeke.berlin> and others
Copyright (c) 2022 Leon Sorokin
Copyright (c) Project Nayuki
Copyright (c) 2023 Anthony Fu <https://github.com/antfu>

Permission is hereby granted, free of charge, to any person obtaining a copy
of this software and associated documentation files (the "Software"), to deal
in the Software without restriction, including without limitation the rights
to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
copies of the Software, and to permit persons to whom the Software is
furnished to do so, subject to the following conditions:

The above copyright notice and this permission notice shall be included in
all copies or substantial portions of the Software.

THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN
THE SOFTWARE.
*/
var b=class{constructor(t,e){this.host=e;let n=(r,s)=>this.bytes.slice(r,r+s),o=(r,s)=>new TextDecoder().decode(n(r,s)),u={send_text:(r,s)=>this.host.send_text(o(r,s)),send_frame:(r,s)=>this.host.send_frame(n(r,s).buffer),add_kernel:(r,s)=>this.add_kernel(n(r,s)),drop_kernel:r=>this.exports.__indirect_function_table.set(r,null)};this.exports=new WebAssembly.Instance(t,{page:u,wasi_snapshot_preview1:this.system(t)}).exports,this.exports._initialize()}host;exports;words="";carry([t,e]){this.exports.carry(...this.put(t),...this.put(e))}begin({name:t,text:e,overrides:n,is_exact:o}){return this.exports.begin(...this.put(t),...this.put(e),...this.put(n),Number(o))!==0}receive(t){this.exports.receive(...this.put(t))}turn(){return this.exports.turn()!==0}get bytes(){return new Uint8Array(this.exports.memory.buffer)}put(t){let e=typeof t=="string"?new TextEncoder().encode(t):t,n=this.exports.allocate(e.length)>>>0;return this.bytes.set(e,n),[n,e.length]}add_kernel(t){let{memory:e,__indirect_function_table:n}=this.exports;try{let{run:o}=new WebAssembly.Instance(new WebAssembly.Module(t),{env:{memory:e}}).exports,u=n.grow(1);return n.set(u,o),u}catch{return 0}}system(t){let e=()=>new DataView(this.exports.memory.buffer),n={clock_time_get:(r,s,c)=>(e().setBigUint64(c,BigInt(Math.round(performance.now()*1e6)),!0),0),fd_write:(r,s,c,x)=>{let d=0;for(let a=0;a<c;++a){let f=e().getUint32(s+8*a,!0),_=e().getUint32(s+8*a+4,!0);this.words+=new TextDecoder().decode(this.bytes.slice(f,f+_)),d+=_}e().setUint32(x,d,!0);let g=this.words.split(`
`);this.words=g.pop();for(let a of g)console.error(a);return 0},proc_exit:()=>{throw new Error("it has left")}},o=52,u=WebAssembly.Module.imports(t).filter(r=>r.module==="wasi_snapshot_preview1");return Object.fromEntries(u.map(({name:r})=>[r,n[r]??(()=>o)]))}};var l=self,y=new MessageChannel,m,p=!1;function h(){p||(p=!0,y.port2.postMessage(null))}y.port1.onmessage=()=>{p=!1,m.turn()&&h()};l.onmessage=({data:i})=>{if(typeof i=="string")return m?(m.receive(i),h()):void 0;let t=new b(i.engine,{send_text:e=>l.postMessage(e),send_frame:e=>l.postMessage(e,[e])});i.carried.files.forEach(e=>t.carry(e)),t.begin(i.carried)&&(i.linked&&t.begin(i.linked),m=t)};
