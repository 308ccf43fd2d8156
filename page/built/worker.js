/*! Cascade. This file contains CodeMirror, Lezer and uPlot, under the following license.

MIT License

Copyright (C) 2018-2021 by Marijn Haverbeke <marijn@haverbeke.berlin> and others
Copyright (c) 2022 Leon Sorokin

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
var l=class extends Error{},m=class{constructor(e,r){this.host=r;let n=(t,s)=>this.bytes.slice(t,t+s),b=(t,s)=>new TextDecoder().decode(n(t,s)),o={send_text:(t,s)=>this.host.send_text(b(t,s)),send_frame:(t,s)=>this.host.send_frame(n(t,s).buffer),add_kernel:(t,s)=>this.add_kernel(n(t,s)),drop_kernel:t=>this.exports.__indirect_function_table.set(t,null)};this.exports=new WebAssembly.Instance(e,{page:o,wasi_snapshot_preview1:this.system(e)}).exports,this.exports._initialize()}host;exports;words="";carry([e,r]){this.exports.carry(...this.put(e),...this.put(r))}begin({name:e,text:r,overrides:n}){return this.exports.begin(...this.put(e),...this.put(r),...this.put(n))!==0}receive(e){this.exports.receive(...this.put(e))}turn(){return this.exports.turn()!==0}get bytes(){return new Uint8Array(this.exports.memory.buffer)}put(e){let r=typeof e=="string"?new TextEncoder().encode(e):e,n=this.exports.allocate(r.length)>>>0;return this.bytes.set(r,n),[n,r.length]}add_kernel(e){let{memory:r,__indirect_function_table:n}=this.exports;try{let{run:b}=new WebAssembly.Instance(new WebAssembly.Module(e),{env:{memory:r}}).exports,o=n.grow(1);return n.set(o,b),o}catch{return 0}}system(e){let r=()=>new DataView(this.exports.memory.buffer),n={clock_time_get:(t,s,c)=>(r().setBigUint64(c,BigInt(Math.round(performance.now()*1e6)),!0),0),fd_write:(t,s,c,w)=>{let g=0;for(let u=0;u<c;++u){let y=r().getUint32(s+8*u,!0),h=r().getUint32(s+8*u+4,!0);this.words+=new TextDecoder().decode(this.bytes.slice(y,y+h)),g+=h}r().setUint32(w,g,!0);let f=this.words.split(`
`);this.words=f.pop();for(let u of f)console.error(u);return 0},proc_exit:()=>{throw new l("the engine has ended")}},b=52,o=WebAssembly.Module.imports(e).filter(t=>t.module==="wasi_snapshot_preview1");return Object.fromEntries(o.map(({name:t})=>[t,n[t]??(()=>b)]))}};var p=self,_=new MessageChannel,a,d=!1;function x(){d||(d=!0,_.port2.postMessage(null))}_.port1.onmessage=()=>{d=!1,a.turn()&&x()};p.onmessage=({data:i})=>{if(typeof i=="string")return a.receive(i),x();a=new m(i.engine,{send_text:e=>p.postMessage(e),send_frame:e=>p.postMessage(e,[e])}),i.carried.files.forEach(e=>a.carry(e)),(!i.linked||!a.begin(i.linked))&&a.begin(i.carried)};
