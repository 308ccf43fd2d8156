" Vim syntax file of Cascade scripts. Written by editors/make.py.
if exists("b:current_syntax")
  finish
endif

" Of the items that begin at one place, Vim takes the last.
syntax match cascadeValue /\<\%(curvature_gauss\|curvature_high\|curvature_mean\|curvature_low\|curvature\|step\|nx\|ny\|nz\|pi\|sx\|sy\|sz\|t\|x\|y\|z\)\>\%(\s*[:(]\)\@!/
syntax match cascadeWord /[:,]\s*\zs\%(symplectic\|isotropic\|creature\|gradient\|implicit\|periodic\|vertices\|feather\|giraffe\|leopard\|coarse\|double\|etdrk4\|fourth\|noflux\|single\|sphere\|steady\|euler\|faces\|fixed\|plate\|slope\|thorn\|torus\|zebra\|auto\|axis\|ball\|fish\|flux\|frog\|hair\|imex\|knot\|rk23\|rk45\|rkl1\|rkl2\|ros2\|turk\|rk2\|rk4\|fv\)\>/
syntax match cascadeFunction /\<\%(smoothstep\|symmetric\|transport\|convolve\|distance\|diamond\|diffuse\|lattice\|palette\|shifted\|advect\|length\|normal\|random\|stripe\|tensor\|vector\|along\|atan2\|clamp\|cross\|field\|floor\|gauss\|grad2\|hypot\|image\|noise\|round\|white\|acos\|asin\|atan\|attr\|cbrt\|ceil\|cosh\|curl\|disc\|grad\|keys\|mean\|ring\|sign\|sinh\|sqrt\|step\|tanh\|unit\|abs\|box\|cos\|div\|dot\|dxx\|dxy\|dxz\|dyy\|dyz\|dzz\|exp\|lap\|log\|max\|min\|mix\|mod\|own\|pow\|rgb\|sin\|sum\|tan\|dx\|dy\|dz\|if\)\>\ze\s*(/
syntax match cascadeKeyword /\<\%(after\|over\|and\|not\|in\|or\)\>\%(\s*[:(]\)\@!/
syntax match cascadeKeyword /\<\%(system_name\|picture\|domain\|system\|cells\|shape\|stage\|let\|use\|fn\)\>\ze\%(\s\+[A-Za-z_Α-ω"]\|\s*[{:]\)/
syntax match cascadeSetting /\<\%(largest_step\|directions\|iterations\|laplacian\|metalness\|precision\|roughness\|tolerance\|undiluted\|boundary\|duration\|emission\|founders\|interval\|opacity\|spacing\|stencil\|stretch\|surface\|border\|bottom\|detail\|divide\|extent\|facing\|frozen\|height\|length\|metric\|remove\|solver\|about\|along\|cells\|check\|color\|every\|front\|reach\|right\|shape\|sides\|speed\|start\|title\|until\|width\|back\|body\|cite\|grid\|left\|mask\|mesh\|seed\|show\|size\|skin\|tilt\|unit\|die\|top\|up\)\>\ze\s*:/
syntax match cascadeKeyword /\<over\s\+\%(touching\|domain\|near\)\>/
syntax match cascadeNumber /\%(\<\d\+\%(\.\.\@!\d*\)\=\|[0-9A-Za-z_.]\@1<!\.\d\+\)\%([eE][+-]\=\d\+\)\=/
syntax match cascadeString /"[^"]*\%("\|$\)/
syntax match cascadeComment /#.*$/
syntax match cascadeDoc /##\%([^#].*\)\=$/

highlight default link cascadeValue Constant
highlight default link cascadeWord Special
highlight default link cascadeFunction Function
highlight default link cascadeKeyword Keyword
highlight default link cascadeSetting Identifier
highlight default link cascadeNumber Number
highlight default link cascadeString String
highlight default link cascadeComment Comment
highlight default link cascadeDoc SpecialComment

let b:current_syntax = "cascade"
