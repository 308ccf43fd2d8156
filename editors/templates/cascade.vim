" Vim syntax file of Cascade scripts. Written by editors/make.py.
if exists("b:current_syntax")
  finish
endif

" Of the items that begin at one place, Vim takes the last.
syntax match cascadeValue /\<\%(@values:vim@\)\>\%(\s*[:(]\)\@!/
syntax match cascadeWord /[:,]\s*\zs\%(@words:vim@\)\>/
syntax match cascadeFunction /\<\%(@functions:vim@\)\>\ze\s*(/
syntax match cascadeKeyword /\<\%(@between:vim@\)\>\%(\s*[:(]\)\@!/
syntax match cascadeKeyword /\<\%(@beginnings:vim@\)\>\ze\%(\s\+[A-Za-z_Α-ω"]\|\s*[{:]\)/
syntax match cascadeSetting /\<\%(@settings:vim@\)\>\ze\s*:/
syntax match cascadeKeyword /\<over\s\+\%(@regions:vim@\)\>/
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
