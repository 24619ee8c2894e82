" The language of qdot's scripts. What stands between `words` and `end` is written by
" tools/editors from the words that the program itself lists.
if exists("b:current_syntax")
  finish
endif

syntax case match
syntax match qdotStatement /\%(^\|[;{]\)\s*\zs\h\w*/ contains=qdotWord,qdotFunction,qdotValue
syntax match qdotOption /\%(\S\s\+\)\@<=\<\%(mass\|at\|on\|to\|inertia\|about\|angle\|euler\|rotation\|between\|stiffness\|rest\|coefficient\|material\|tol\|method\|as\|with\|digits\|constraints\|rising\|falling\|stop\|then\|every\|vs\|for\|when\|within\|exactly\|step\|count\|seed\|from\|range\|log\|title\|labels\|size\|keep\|such\|that\|of\|in\)\>/
syntax match qdotNumber /\<\d\+\%(\.\d\+\)\?\%([eE][-+]\?\d\+\)\?\>/
syntax match qdotPrime /'\+/
syntax region qdotText start=/"/ end=/"/ oneline
syntax keyword qdotConstant pi t
syntax keyword qdotOperator and or not
syntax match qdotComment /#.*$/ contains=@Spell,qdotTodo
syntax keyword qdotTodo TODO FIXME contained
" words
syntax keyword qdotWord contained abbreviate animate assume body check constraint continue
syntax keyword qdotWord contained coord cyclic damper derive dissipation dof equilibria
syntax keyword qdotWord contained event events export find fit floquet force forces
syntax keyword qdotWord contained function gravity help include lagrangian longtime
syntax keyword qdotWord contained lyapunov modes param particle plan plot poincare
syntax keyword qdotWord contained potential print quit race reactions redo remove report
syntax keyword qdotWord contained reset run save scale scene sensitivity set show spring
syntax keyword qdotWord contained start style sweep table timing torque undo vars
syntax keyword qdotWord contained workprecision
syntax keyword qdotFunction N abs acos acosh asin asinh atan atan2 atanh christoffel
syntax keyword qdotFunction collect cos cosh cot cross csc curl ddt det diff divergence
syntax keyword qdotFunction dot drift ds2 eigenvalues erf erfc exp expand factor floor
syntax keyword qdotFunction geodesic gradient if inverse laplacian latex lhs log max mean
syntax keyword qdotFunction metric min mod norm numeric point poisson residual rhs ricci
syntax keyword qdotFunction riemann routhian scalar_curvature scale_factors sec series
syntax keyword qdotFunction sign simplify sin sinh size solve speed2 spin sqrt stability
syntax keyword qdotFunction subs sum tan tanh trace transpose value velocity
syntax keyword qdotFunction volume_element
syntax keyword qdotValue H L Q T V accel conserved cyclic delta dof ds2 energy eom
syntax keyword qdotValue equilibria forces hamiltonian kinetic lagrange_function lambda
syntax keyword qdotValue mass_matrix modes momenta p potential_energy reactions routhian
syntax keyword qdotValue speed2 stable stable_to_first_order undecided unstable
syntax keyword qdotValue virtual_work
" end

highlight default link qdotWord Statement
highlight default link qdotOption Keyword
highlight default link qdotFunction Function
highlight default link qdotValue Identifier
highlight default link qdotConstant Constant
highlight default link qdotOperator Operator
highlight default link qdotNumber Number
highlight default link qdotPrime Special
highlight default link qdotText String
highlight default link qdotComment Comment
highlight default link qdotTodo Todo

let b:current_syntax = "qdot"
