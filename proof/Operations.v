(* SPDX-License-Identifier: MIT *)
(* The operations that programs consist of, and what they do to binary32 values, infinities and NaN included: Flocq's
   IEEE 754 numbers, rounded to nearest even. PerPower is said for normal numbers alone, and Const 0 may have either
   sign. Then lemmas that say when results are finite. *)
From Coq Require Import Reals Lra Psatz ZArith String List Bool.
From Flocq Require Import Core BinarySingleNaN.
From Swivel Require Import Wrist Rounding.
Open Scope R_scope.

Inductive condition := Lt (a b : string) | Le (a b : string) | And (c d : condition).
Inductive operation :=
  | Const (mantissa exponent : Z)  (* mantissa 2^exponent *)
  | Add (a b : string) | Sub (a b : string) | Mul (a b : string) | Div (a b : string) | Sqrt (a : string)
  | Neg (a : string) | Abs (a : string)
  | Flip (a sign : string)  (* a, or -a where the sign bit is set *)
  | Copysign (a sign : string)  (* the size of a with that sign bit *)
  | PerPower (a : string)  (* 1/2 divided by the largest power of two that is not above a *)
  | Select (c : condition) (a b : string).

Notation value := (binary_float 24 128).
Global Instance emax128 : Prec_lt_emax 24 128 := eq_refl.
Definition add : value -> value -> value := Bplus mode_NE.
Definition sub : value -> value -> value := Bminus mode_NE.
Definition mul : value -> value -> value := Bmult mode_NE.
Definition div : value -> value -> value := Bdiv mode_NE.
Definition root : value -> value := Bsqrt mode_NE.
Definition flip (x sign : value) : value := if Bsign sign then Bopp x else x.
Definition with_sign (x sign : value) : value := if Bsign sign then Bopp (Babs x) else Babs x.

Definition environment := string -> value.
Fixpoint truth (e : environment) (c : condition) : bool :=
  match c with
  | Lt a b => Bltb (e a) (e b)
  | Le a b => Bleb (e a) (e b)
  | And c d => truth e c && truth e d
  end.
Definition computes (e : environment) (line : string * operation) : Prop :=
  let (name, o) := line in
  match o with
  | Const m k => is_finite (e name) = true /\ B2R (e name) = F2R (Float radix2 m k)
  | Add a b => e name = add (e a) (e b)
  | Sub a b => e name = sub (e a) (e b)
  | Mul a b => e name = mul (e a) (e b)
  | Div a b => e name = div (e a) (e b)
  | Sqrt a => e name = root (e a)
  | Neg a => e name = Bopp (e a)
  | Abs a => e name = Babs (e a)
  | Flip a s => e name = flip (e a) (e s)
  | Copysign a s => e name = with_sign (e a) (e s)
  | PerPower a => is_finite (e a) = true -> bpow radix2 (-126) <= B2R (e a) ->
      is_finite (e name) = true /\ B2R (e name) = bpow radix2 (- mag radix2 (B2R (e a)))
  | Select c a b => e name = if truth e c then e a else e b
  end.
(* e gives every name of a program its value *)
Definition runs (e : environment) (lines : list (string * operation)) := fold_right (fun line rest => computes e line
  /\ rest) True lines.

(* finite, and of a size up to 2^n *)
Record upto n (v : value) : Prop := Upto { upto_finite : is_finite v = true;
  upto_size : Rabs (B2R v) <= bpow radix2 n }.
Lemma upto_le n n' v : upto n v -> (n <= n')%Z -> upto n' v.
Proof. intros [F B] H. split. exact F. apply Rle_trans with (1 := B). now apply bpow_le. Qed.
Lemma small x n : (-149 <= n)%Z -> (n < 128)%Z -> Rabs x <= bpow radix2 n ->
  Rlt_bool (Rabs (fl32 x)) (bpow radix2 128) = true.
Proof. intros H1 H2 H. apply Rlt_bool_true. apply Rle_lt_trans with (bpow radix2 n). now apply fl_abs_le.
  now apply bpow_lt. Qed.
Lemma add_exact x y n : is_finite x = true -> is_finite y = true -> (-149 <= n < 128)%Z ->
  Rabs (B2R x + B2R y) <= bpow radix2 n ->
  upto n (add x y) /\ B2R (add x y) = fl32 (B2R x + B2R y).
Proof.
  intros Fx Fy Hn H. pose proof (Bplus_correct 24 128 _ _ mode_NE x y Fx Fy) as C.
    change (round _ _ _ _) with (fl32 (B2R x + B2R y)) in C.
  rewrite (small _ n) in C by (try assumption; lia). destruct C as [C1 [C2 _]]. unfold add.
    split; [split|]; rewrite ?C1, ?C2, ?Fx, ?Fy; try reflexivity. apply fl_abs_le; [lia|assumption].
Qed.
Lemma sub_exact x y n : is_finite x = true -> is_finite y = true -> (-149 <= n < 128)%Z ->
  Rabs (B2R x - B2R y) <= bpow radix2 n ->
  upto n (sub x y) /\ B2R (sub x y) = fl32 (B2R x - B2R y).
Proof.
  intros Fx Fy Hn H. pose proof (Bminus_correct 24 128 _ _ mode_NE x y Fx Fy) as C.
    change (round _ _ _ _) with (fl32 (B2R x - B2R y)) in C.
  rewrite (small _ n) in C by (try assumption; lia). destruct C as [C1 [C2 _]]. unfold sub.
    split; [split|]; rewrite ?C1, ?C2, ?Fx, ?Fy; try reflexivity. apply fl_abs_le; [lia|assumption].
Qed.
Lemma mul_exact x y n : is_finite x = true -> is_finite y = true -> (-149 <= n < 128)%Z ->
  Rabs (B2R x * B2R y) <= bpow radix2 n ->
  upto n (mul x y) /\ B2R (mul x y) = fl32 (B2R x * B2R y).
Proof.
  intros Fx Fy Hn H. pose proof (Bmult_correct 24 128 _ _ mode_NE x y) as C.
    change (round _ _ _ _) with (fl32 (B2R x * B2R y)) in C.
  rewrite (small _ n) in C by (try assumption; lia). destruct C as [C1 [C2 _]]. unfold mul.
    split; [split|]; rewrite ?C1, ?C2, ?Fx, ?Fy; try reflexivity. apply fl_abs_le; [lia|assumption].
Qed.
Lemma div_exact x y n : is_finite x = true -> B2R y <> 0 -> (-149 <= n < 128)%Z ->
  Rabs (B2R x / B2R y) <= bpow radix2 n ->
  upto n (div x y) /\ B2R (div x y) = fl32 (B2R x / B2R y).
Proof.
  intros Fx Ny Hn H. pose proof (Bdiv_correct 24 128 _ _ mode_NE x y Ny) as C.
    change (round _ _ _ _) with (fl32 (B2R x / B2R y)) in C.
  rewrite (small _ n) in C by (try assumption; lia). destruct C as [C1 [C2 _]]. unfold div.
    split; [split|]; rewrite ?C1, ?C2, ?Fx, ?Fy; try reflexivity. apply fl_abs_le; [lia|assumption].
Qed.
Lemma root_exact x n : is_finite x = true -> 0 <= B2R x -> (0 <= n)%Z -> B2R x <= bpow radix2 n ->
  upto n (root x) /\ B2R (root x) = fl32 (sqrt (B2R x)).
Proof.
  intros Fx Px Hn H. pose proof (Bsqrt_correct 24 128 _ _ mode_NE x) as [C1 [C2 _]].
    change (round _ _ _ _) with (fl32 (sqrt (B2R x))) in C1.
  unfold root. split; [split|]; rewrite ?C1, ?C2; try reflexivity.
  - destruct x as [s|s| |s m e B]; try discriminate; try reflexivity. destruct s; [exfalso|reflexivity].
    assert (L : F2R (Float radix2 (cond_Zopp true (Zpos m)) e) < 0) by (now apply F2R_lt_0). simpl in Px, L. lra.
  - apply fl_abs_le. lia. rewrite Rabs_right by (apply Rle_ge, sqrt_pos).
    assert (1 <= bpow radix2 n) by (change 1 with (bpow radix2 0); apply bpow_le; lia).
    rewrite <- (sqrt_square (bpow radix2 n)) by lra. apply sqrt_le_1_alt. apply Rle_trans with (1 := H).
    rewrite <- (Rmult_1_r (bpow radix2 n)) at 1. apply Rmult_le_compat_l; lra.
Qed.
Lemma add_upto x y n : upto n x -> upto n y -> (-149 <= n < 127)%Z ->
  upto (n + 1) (add x y) /\ B2R (add x y) = fl32 (B2R x + B2R y).
Proof.
  intros [Fx Bx] [Fy By] Hn. apply add_exact; try assumption. lia. rewrite bpow_plus. simpl (bpow radix2 1).
    eapply Rle_trans. apply Rabs_triang. lra.
Qed.
Lemma sub_upto x y n : upto n x -> upto n y -> (-149 <= n < 127)%Z ->
  upto (n + 1) (sub x y) /\ B2R (sub x y) = fl32 (B2R x - B2R y).
Proof.
  intros [Fx Bx] [Fy By] Hn. apply sub_exact; try assumption. lia. rewrite bpow_plus. simpl (bpow radix2 1).
  eapply Rle_trans. apply Rabs_triang. rewrite Rabs_Ropp. lra.
Qed.
Lemma mul_upto x y n m : upto n x -> upto m y -> (-149 <= n + m < 128)%Z ->
  upto (n + m) (mul x y) /\ B2R (mul x y) = fl32 (B2R x * B2R y).
Proof.
  intros [Fx Bx] [Fy By] Hn. apply mul_exact; try assumption. rewrite bpow_plus, Rabs_mult.
    apply Rmult_le_compat; try assumption; apply Rabs_pos.
Qed.
Lemma opp_upto x n : upto n x -> upto n (Bopp x) /\ B2R (Bopp x) = - B2R x.
Proof. intros [F B]. split; [split|]; rewrite ?is_finite_Bopp, ?B2R_Bopp, ?Rabs_Ropp; auto. Qed.
Lemma abs_upto x n : upto n x -> upto n (Babs x) /\ B2R (Babs x) = Rabs (B2R x).
Proof. intros [F B]. split; [split|]; rewrite ?is_finite_Babs, ?B2R_Babs, ?Rabs_Rabsolu; auto. Qed.
(* the sign of a value, as a factor *)
Definition sign_of (v : value) : R := if Bsign v then -1 else 1.
Lemma sign_of_1 v : sign_of v = 1 \/ sign_of v = -1.
Proof. unfold sign_of. destruct (Bsign v); auto. Qed.
Lemma sign_of_abs v : is_finite v = true -> sign_of v * B2R v = Rabs (B2R v).
Proof.
  unfold sign_of. destruct v as [s|s| |s m e B]; intro F; try discriminate; simpl.
  - rewrite Rabs_R0. ring.
  - destruct s; simpl.
    + rewrite Rabs_left. ring. now apply F2R_lt_0.
    + rewrite Rabs_right. ring. apply Rle_ge, F2R_ge_0. easy.
Qed.
Lemma flip_upto x s n : upto n x -> upto n (flip x s) /\ B2R (flip x s) = sign_of s * B2R x.
Proof. intro U. unfold flip, sign_of. destruct (Bsign s). destruct (opp_upto _ _ U) as [A ->]. split. exact A. ring.
  split. exact U. ring. Qed.
Lemma with_sign_upto x s n : upto n x -> upto n (with_sign x s) /\ B2R (with_sign x s) = sign_of s * Rabs (B2R x).
Proof.
  intro U. destruct (abs_upto _ _ U) as [A E]. unfold with_sign, sign_of. destruct (Bsign s).
  destruct (opp_upto _ _ A) as [A' ->]. rewrite E. split. exact A'. ring. rewrite E. split. exact A. ring.
Qed.
Lemma float_value (v : value) : is_float (B2R v).
Proof. unfold is_float. apply (generic_format_B2R 24 128). Qed.
Lemma lt_true (x y : value) : is_finite x = true -> is_finite y = true -> Bltb x y = true -> B2R x < B2R y.
Proof. intros Fx Fy H. rewrite Bltb_correct in H by assumption.
  destruct (Rlt_bool_spec (B2R x) (B2R y)); [assumption|discriminate]. Qed.
Lemma lt_false (x y : value) : is_finite x = true -> is_finite y = true -> Bltb x y = false -> B2R y <= B2R x.
Proof. intros Fx Fy H. rewrite Bltb_correct in H by assumption.
  destruct (Rlt_bool_spec (B2R x) (B2R y)); [discriminate|assumption]. Qed.
Lemma le_true (x y : value) : is_finite x = true -> is_finite y = true -> Bleb x y = true -> B2R x <= B2R y.
Proof. intros Fx Fy H. rewrite Bleb_correct in H by assumption.
  destruct (Rle_bool_spec (B2R x) (B2R y)); [assumption|discriminate]. Qed.
Lemma le_false (x y : value) : is_finite x = true -> is_finite y = true -> Bleb x y = false -> B2R y < B2R x.
Proof. intros Fx Fy H. rewrite Bleb_correct in H by assumption.
  destruct (Rle_bool_spec (B2R x) (B2R y)); [discriminate|assumption]. Qed.

(* Not negative, perhaps infinite, not NaN *)
Definition not_negative (v : value) := match v with B754_zero _ | B754_infinity false | B754_finite false _ _ _ => True
  | _ => False end.
Lemma not_negative_finite v : not_negative v -> is_finite v = true -> 0 <= B2R v.
Proof. destruct v as [s|[|]| |[|] m e B]; simpl; intros H F; try contradiction; try lra; try discriminate.
  apply F2R_ge_0. easy. Qed.
Lemma finite_not_negative v : is_finite v = true -> 0 <= B2R v -> not_negative v.
Proof.
  destruct v as [s|[|]| |[|] m e B]; simpl; intros F H; try exact I; try discriminate.
  assert (L : F2R (Float radix2 (cond_Zopp true (Zpos m)) e) < 0) by (now apply F2R_lt_0). simpl in L. lra.
Qed.
Lemma overflow_infinite s : binary_overflow 24 128 mode_NE s = SpecFloat.S754_infinity s.
Proof. reflexivity. Qed.
Lemma infinite_value (v : value) s : B2SF v = SpecFloat.S754_infinity s -> v = B754_infinity s.
Proof. destruct v; simpl; intro H; try discriminate. now injection H as ->. Qed.
Lemma add_not_negative x y : not_negative x -> not_negative y -> not_negative (add x y).
Proof.
  intros Hx Hy. destruct (is_finite x) eqn:Fx; [destruct (is_finite y) eqn:Fy|].
  - pose proof (Bplus_correct 24 128 _ _ mode_NE x y Fx Fy) as C.
    change (round _ _ _ _) with (fl32 (B2R x + B2R y)) in C.
    destruct (Rlt_bool _ _).
    + destruct C as [C1 [C2 _]]. apply finite_not_negative. exact C2. unfold add. rewrite C1. apply fl_pos.
      pose proof (not_negative_finite _ Hx Fx). pose proof (not_negative_finite _ Hy Fy). lra.
    + destruct C as [C1 C2]. rewrite overflow_infinite in C1. apply infinite_value in C1. unfold add. rewrite C1.
      destruct x as [s|[|]| |[|] m e B]; simpl in *; try contradiction; try exact I; try discriminate.
      (* a zero: the sum is y itself *)
      exfalso. destruct y as [s'|[|]| |[|] m e B]; simpl in *; try contradiction; try discriminate.
        destruct (Bool.eqb _ _); discriminate.
  - destruct x as [s|[|]| |[|] m e B]; try discriminate; try contradiction; destruct y as [s'|[|]| |[|] m' e' B'];
    try discriminate; try contradiction; exact I.
  - destruct x as [s|[|]| |[|] m e B]; try discriminate; try contradiction; destruct y as [s'|[|]| |[|] m' e' B'];
    try contradiction; exact I.
Qed.
Lemma square_not_negative x : is_finite x = true -> not_negative (mul x x).
Proof.
  intro Fx. pose proof (Bmult_correct 24 128 _ _ mode_NE x x) as C.
    change (round _ _ _ _) with (fl32 (B2R x * B2R x)) in C.
  destruct (Rlt_bool _ _).
  - destruct C as [C1 [C2 _]]. rewrite Fx in C2. apply finite_not_negative. exact C2. unfold mul. rewrite C1.
    apply fl_pos. apply Rle_0_sqr.
  - rewrite overflow_infinite, xorb_nilpotent in C. apply infinite_value in C. unfold mul. rewrite C. exact I.
Qed.
Lemma abs_not_negative x : is_finite x = true -> not_negative (Babs x).
Proof. intro F. apply finite_not_negative. now rewrite is_finite_Babs. rewrite B2R_Babs. apply Rabs_pos. Qed.
(* Sums that are finite have finite terms. *)
Lemma add_finite x y : is_finite (add x y) = true -> is_finite x = true /\ is_finite y = true.
Proof. destruct x as [s|[|]| |s m e B]; destruct y as [s'|[|]| |s' m' e' B']; simpl; intro H; try discriminate; auto.
  Qed.
Lemma finite_sum x y : is_finite x = true -> is_finite y = true -> is_finite (add x y) = true ->
  B2R (add x y) = fl32 (B2R x + B2R y).
Proof.
  intros Fx Fy F. pose proof (Bplus_correct 24 128 _ _ mode_NE x y Fx Fy) as C.
    change (round _ _ _ _) with (fl32 (B2R x + B2R y)) in C.
  destruct (Rlt_bool _ _). now destruct C. destruct C as [C _]. rewrite overflow_infinite in C.
    apply infinite_value in C. unfold add in F. rewrite C in F. discriminate.
Qed.
Lemma finite_product x y : is_finite x = true -> is_finite y = true -> is_finite (mul x y) = true ->
  B2R (mul x y) = fl32 (B2R x * B2R y).
Proof.
  intros Fx Fy F. pose proof (Bmult_correct 24 128 _ _ mode_NE x y) as C.
    change (round _ _ _ _) with (fl32 (B2R x * B2R y)) in C.
  destruct (Rlt_bool _ _). now destruct C. rewrite overflow_infinite in C. apply infinite_value in C. unfold mul in F.
    rewrite C in F. discriminate.
Qed.
(* A difference or sum of finite values may overflow, but it is no NaN. *)
Lemma add_overflow x y : is_finite x = true -> is_finite y = true ->
  is_finite (add x y) = true \/ (add x y = B754_infinity (Bsign x) /\ Bsign x = Bsign y).
Proof.
  intros Fx Fy. pose proof (Bplus_correct 24 128 _ _ mode_NE x y Fx Fy) as C. destruct (Rlt_bool _ _).
  left. now destruct C as [_ [C _]]. right. destruct C as [C S]. rewrite overflow_infinite in C.
    apply infinite_value in C. now split.
Qed.
Lemma sub_overflow x y : is_finite x = true -> is_finite y = true ->
  is_finite (sub x y) = true \/ (sub x y = B754_infinity (Bsign x) /\ Bsign x = negb (Bsign y)).
Proof.
  intros Fx Fy. pose proof (Bminus_correct 24 128 _ _ mode_NE x y Fx Fy) as C. destruct (Rlt_bool _ _).
  left. now destruct C as [_ [C _]]. right. destruct C as [C S]. rewrite overflow_infinite in C.
    apply infinite_value in C. now split.
Qed.
Lemma finite_difference x y : is_finite x = true -> is_finite y = true -> is_finite (sub x y) = true ->
  B2R (sub x y) = fl32 (B2R x - B2R y).
Proof.
  intros Fx Fy F. pose proof (Bminus_correct 24 128 _ _ mode_NE x y Fx Fy) as C.
    change (round _ _ _ _) with (fl32 (B2R x - B2R y)) in C.
  destruct (Rlt_bool _ _). now destruct C. destruct C as [C _]. rewrite overflow_infinite in C.
    apply infinite_value in C. unfold sub in F. rewrite C in F. discriminate.
Qed.
Lemma finite_within x y : is_finite x = true -> is_finite y = true -> Rabs (B2R x * B2R y) <= 3.4e38 ->
  is_finite (mul x y) = true /\ B2R (mul x y) = fl32 (B2R x * B2R y).
Proof.
  intros Fx Fy H. pose proof (Bmult_correct 24 128 _ _ mode_NE x y) as C.
    change (round _ _ _ _) with (fl32 (B2R x * B2R y)) in C.
  rewrite Rlt_bool_true in C. destruct C as [C1 [C2 _]]. unfold mul. rewrite C1, C2, Fx, Fy. split; reflexivity.
  destruct (fl32_ok (B2R x * B2R y)) as [e [h [K [E Q]]]]. rewrite Q. unfold eta in E. eapply Rle_lt_trans.
    apply Rabs_triang. rewrite Rabs_mult.
  apply ok_low in K. rewrite u_val in K. rewrite (Rabs_right (1 + e)) by lra. pose proof (Rabs_pos (B2R x * B2R y)).
  assert (Rabs (B2R x * B2R y) * (1 + e) <= 3.4e38 * 1.0000001) by (apply Rmult_le_compat; lra). simpl (bpow _ _). lra.
Qed.
(* lo(x, y) >= least > 0 *)
Definition lo (x y : value) := if Bltb x y then x else y.
Lemma lo_first (least x y : value) : is_finite least = true -> is_finite x = true -> Bleb least (lo x y) = true ->
  B2R least <= B2R x.
Proof.
  intros Fl Fx H. unfold lo in H. destruct (Bltb x y) eqn:L. now apply le_true.
  destruct (is_finite y) eqn:Fy. apply lt_false in L; try assumption. apply le_true in H; try assumption. lra.
  destruct y as [s|[|]| |s m e B]; try discriminate; destruct x as [s'|[|]| |s' m' e' B'];
    destruct least as [s''|[|]| |s'' m'' e'' B'']; simpl in *; try discriminate;
    destruct s''; discriminate.
Qed.
Lemma lo_second (least x y : value) : is_finite least = true -> is_finite x = true -> is_finite y = true ->
  Bleb least (lo x y) = true -> B2R least <= B2R y.
Proof.
  intros Fl Fx Fy H. unfold lo in H. destruct (Bltb x y) eqn:L. apply lt_true in L; try assumption.
    apply le_true in H; try assumption. lra. now apply le_true.
Qed.
Lemma lo_minus_infinity (least y : value) : is_finite least = true -> Bleb least (lo (B754_infinity true) y) = false.
Proof.
  intro Fl. unfold lo. destruct y as [s|[|]| |s m e B]; destruct least as [s'|[|]| |[|] m' e' B']; simpl in *;
    try discriminate; try reflexivity.
Qed.
