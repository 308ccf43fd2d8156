;;; cascade-mode.el --- Major mode for Cascade scripts  -*- lexical-binding: t -*-

;; Package-Requires: ((emacs "27.1"))
;; Written by editors/make.py.

;;; Commentary:

;; (add-to-list 'load-path "…/editors/emacs")
;; (require 'cascade-mode)
;; (add-hook 'cascade-mode-hook #'eglot-ensure)   ; Emacs 29, or the package eglot

;;; Code:

(defgroup cascade nil "Scripts that grow patterns." :group 'languages)

(defcustom cascade-program "cascade"
  "The program that runs and checks scripts."
  :type 'string)

(defvar cascade-mode-syntax-table
  (let ((table (make-syntax-table)))
    (modify-syntax-entry ?# "<" table)
    (modify-syntax-entry ?\n ">" table)
    (modify-syntax-entry ?\" "\"" table)
    (modify-syntax-entry ?\\ "." table)
    (modify-syntax-entry ?' "." table)
    (modify-syntax-entry ?_ "w" table)
    (dolist (sign '(?+ ?- ?* ?/ ?< ?> ?= ?^ ?|))
      (modify-syntax-entry sign "." table))
    table)
  "Characters of scripts.")

(defconst cascade--font-lock
  (let ((any (lambda (words) (concat "\\<\\(" (regexp-opt words) "\\)\\>"))))
    `(("\\(?:^\\|[^#]\\)\\(##\\(?:[^#\n].*\\)?\\)$" 1 font-lock-doc-face t)
      ("[^0-9A-Za-z_.]\\(\\.[0-9]+\\(?:[eE][+-]?[0-9]+\\)?\\)" 1 font-lock-constant-face)
      ("\\(?:\\<[0-9]+\\(?:\\.[0-9]+\\|\\.\\(?:[^.0-9]\\|$\\)\\)?\\)\\(?:[eE][+-]?[0-9]+\\)?"
       . font-lock-constant-face)
      ("\\<over\\s-+\\(?:touching\\|domain\\|near\\)\\>" . font-lock-keyword-face)
      (,(concat (funcall any '("largest_step" "directions" "iterations" "laplacian" "metalness" "precision" "roughness" "tolerance" "undiluted" "boundary" "duration" "emission" "founders" "interval" "opacity" "spacing" "stencil" "stretch" "surface" "border" "bottom" "detail" "divide" "extent" "facing" "frozen" "height" "length" "metric" "remove" "solver" "about" "along" "cells" "check" "color" "every" "front" "reach" "right" "shape" "sides" "speed" "start" "title" "until" "width" "back" "body" "cite" "grid" "left" "mask" "mesh" "seed" "show" "size" "skin" "tilt" "unit" "die" "top" "up")) "\\s-*:") 1 font-lock-variable-name-face)
      (,(concat (funcall any '("system_name" "picture" "domain" "system" "cells" "shape" "stage" "let" "use" "fn")) "\\(?:\\s-+[[:alpha:]_\"]\\|\\s-*[{:]\\)")
       1 font-lock-keyword-face)
      (,(funcall any '("after" "over" "and" "not" "in" "or")) . font-lock-keyword-face)
      (,(concat (funcall any '("smoothstep" "symmetric" "transport" "convolve" "distance" "diamond" "diffuse" "lattice" "palette" "shifted" "advect" "length" "normal" "random" "stripe" "tensor" "vector" "along" "atan2" "clamp" "cross" "field" "floor" "gauss" "grad2" "hypot" "image" "noise" "round" "white" "acos" "asin" "atan" "attr" "cbrt" "ceil" "cosh" "curl" "disc" "grad" "keys" "mean" "ring" "sign" "sinh" "sqrt" "step" "tanh" "unit" "abs" "box" "cos" "div" "dot" "dxx" "dxy" "dxz" "dyy" "dyz" "dzz" "exp" "lap" "log" "max" "min" "mix" "mod" "own" "pow" "rgb" "sin" "sum" "tan" "dx" "dy" "dz" "if")) "\\s-*(") 1 font-lock-function-name-face)
      (,(concat "[:,]\\s-*" (funcall any '("symplectic" "isotropic" "creature" "gradient" "implicit" "periodic" "vertices" "feather" "giraffe" "leopard" "coarse" "double" "etdrk4" "fourth" "noflux" "single" "sphere" "steady" "euler" "faces" "fixed" "plate" "slope" "thorn" "torus" "zebra" "auto" "axis" "ball" "fish" "flux" "frog" "hair" "imex" "knot" "rk23" "rk45" "rkl1" "rkl2" "ros2" "turk" "rk2" "rk4" "fv"))) 1 font-lock-type-face)
      (,(concat (funcall any '("curvature_gauss" "curvature_high" "curvature_mean" "curvature_low" "curvature" "step" "nx" "ny" "nz" "pi" "sx" "sy" "sz" "t" "x" "y" "z")) "\\s-*\\(?:[^:( ]\\|$\\)") 1 font-lock-builtin-face)))
  "Colours of words.")

(defun cascade-indent-line ()
  "Indent a line by two columns for each open brace, and by four within brackets."
  (interactive)
  (let ((column
         (save-excursion
           (beginning-of-line)
           (let* ((state (syntax-ppss))
                  (open (nth 9 state))
                  (braces (seq-count (lambda (at) (eq (char-after at) ?\{)) open))
                  (closes (looking-at "[ \t]*}")))
             (+ (* 2 (max 0 (- braces (if closes 1 0))))
                (if (> (length open) braces) 4 0))))))
    (save-excursion (indent-line-to column))
    (when (< (current-column) column) (move-to-column column))))

(defun cascade-run ()
  "Run the script of this buffer, which draws its picture."
  (interactive)
  (save-buffer)
  (compile (format "%s run %s" cascade-program (shell-quote-argument buffer-file-name))))

(defun cascade-view ()
  "Open the script of this buffer in the browser."
  (interactive)
  (save-buffer)
  (start-process "cascade view" "*cascade view*" cascade-program "view" buffer-file-name))

(defvar cascade-mode-map
  (let ((map (make-sparse-keymap)))
    (define-key map (kbd "C-c C-c") #'cascade-run)
    (define-key map (kbd "C-c C-v") #'cascade-view)
    map)
  "Keys of scripts.")

;;;###autoload
(define-derived-mode cascade-mode prog-mode "Cascade"
  "Major mode for Cascade scripts."
  (setq-local comment-start "# "
              comment-start-skip "#+[ \t]*"
              indent-line-function #'cascade-indent-line
              compile-command (concat cascade-program " check "
                                      (and buffer-file-name
                                           (shell-quote-argument buffer-file-name)))
              font-lock-defaults '(cascade--font-lock)))

;;;###autoload
(add-to-list 'auto-mode-alist '("\\.cascade\\'" . cascade-mode))

(with-eval-after-load 'eglot
  (defvar eglot-server-programs)
  (add-to-list 'eglot-server-programs `(cascade-mode . (,cascade-program "lsp"))))

(provide 'cascade-mode)
;;; cascade-mode.el ends here
