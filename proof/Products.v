(* SPDX-License-Identifier: MIT *)
(* The rotor that brings +z to the target is a product: of the middle line between both and a twist, then of a lift.
   Here are the errors of both products, and of the middle line if its height is wrong. u is the largest relative
   error of a rounding; k stands for u (1 + u). *)
From Coq Require Import Reals Lra Psatz.
From Swivel Require Import Rotors.
Open Scope R_scope.

Lemma sq_le a b : Rabs a <= b -> a * a <= b * b.
Proof. intro H. pose proof (Rabs_pos a). replace (a*a) with (Rabs a * Rabs a). nra.
  unfold Rabs; destruct (Rcase_abs a); ring. Qed.
Lemma abs2 a b : Rabs a * Rabs b <= (a*a + b*b) / 2.
Proof. replace (a*a) with (Rabs a * Rabs a) by (unfold Rabs; destruct (Rcase_abs a); ring).
  replace (b*b) with (Rabs b * Rabs b) by (unfold Rabs; destruct (Rcase_abs b); ring).
    pose proof (Rle_0_sqr (Rabs a - Rabs b)). unfold Rsqr in *. nra. Qed.

(* the computed (a + b) of two rounded products, rounded: the error *)
Lemma round_pair u A B d1 d2 d3 : 0 <= u <= 1 -> Rabs d1 <= u -> Rabs d2 <= u -> Rabs d3 <= u ->
  Rabs ((A * (1 + d1) + B * (1 + d2)) * (1 + d3) - (A + B)) <= u * (1 + u) * (Rabs A + Rabs B + Rabs (A + B)).
Proof.
  intros Hu H1 H2 H3.
  replace ((A * (1 + d1) + B * (1 + d2)) * (1 + d3) - (A + B)) with ((A * d1 + B * d2) * (1 + d3) + (A + B) * d3) by
    ring.
  eapply Rle_trans. apply Rabs_triang. rewrite !Rabs_mult.
  assert (Rabs (1 + d3) <= 1 + u). { eapply Rle_trans. apply Rabs_triang. rewrite Rabs_R1. lra. }
  assert (Rabs (A * d1 + B * d2) <= u * (Rabs A + Rabs B)).
  { eapply Rle_trans. apply Rabs_triang. rewrite !Rabs_mult. pose proof (Rabs_pos A). pose proof (Rabs_pos B). nra. }
  pose proof (Rabs_pos (A + B)). pose proof (Rabs_pos (A * d1 + B * d2)). pose proof (Rabs_pos (1 + d3)).
    pose proof (Rabs_pos A). pose proof (Rabs_pos B).
  assert (Rabs (A * d1 + B * d2) * Rabs (1 + d3) <= u * (Rabs A + Rabs B) * (1 + u)).
  { apply Rmult_le_compat; lra. }
  assert (Rabs (A + B) * Rabs d3 <= u * (1 + u) * Rabs (A + B)) by nra.
  lra.
Qed.

Lemma pair_err x y p r e1 e2 k : 0 <= k ->
  Rabs e1 <= k * (Rabs (x*p) + Rabs (y*r) + Rabs (x*p + y*r)) ->
  Rabs e2 <= k * (Rabs (y*p) + Rabs (x*r) + Rabs (y*p - x*r)) ->
  e1*e1 + e2*e2 <= 5.83 * (k*k) * ((x*x + y*y) * (p*p + r*r)).
Proof.
  intros Hk H1 H2. apply sq_le in H1. apply sq_le in H2.
  set (a1 := Rabs (x*p) + Rabs (y*r)) in *. set (a2 := Rabs (y*p) + Rabs (x*r)) in *.
  set (b1 := Rabs (x*p + y*r)) in *. set (b2 := Rabs (y*p - x*r)) in *.
  set (S := (x*x+y*y)*(p*p+r*r)).
  assert (HA : a1*a1 + a2*a2 <= 2 * S).
  { unfold a1, a2. pose proof (abs2 x y) as X. pose proof (abs2 p r) as P.
    rewrite !Rabs_mult.
    assert (E : forall t, Rabs t * Rabs t = t * t) by (intro t; unfold Rabs; destruct (Rcase_abs t); ring).
    assert (N : Rabs x * Rabs y * (Rabs p * Rabs r) <= ((x*x+y*y)/2) * ((p*p+r*r)/2)).
    { apply Rmult_le_compat; try assumption; apply Rmult_le_pos; apply Rabs_pos. }
    replace ((Rabs x * Rabs p + Rabs y * Rabs r) * (Rabs x * Rabs p + Rabs y * Rabs r) + (Rabs y * Rabs p + Rabs x *
      Rabs r) * (Rabs y * Rabs p + Rabs x * Rabs r))
      with ((Rabs x * Rabs x) * (Rabs p * Rabs p) + (Rabs y * Rabs y) * (Rabs r * Rabs r) + (Rabs y * Rabs y) * (Rabs p
        * Rabs p) + (Rabs x * Rabs x) * (Rabs r * Rabs r)
            + 4 * (Rabs x * Rabs y * (Rabs p * Rabs r))) by ring.
    rewrite !E. unfold S. lra. }
  assert (HB : b1*b1 + b2*b2 = S).
  { unfold b1, b2, S. assert (E : forall t, Rabs t * Rabs t = t * t) by (intro t; unfold Rabs; destruct (Rcase_abs t);
    ring). rewrite !E. ring. }
  assert (C : forall a b, (a + b)*(a + b) <= 1.7071 * (a*a) + 2.4143 * (b*b)).
  { intros a b. pose proof (Rle_0_sqr (0.7071*a - b)) as Q. unfold Rsqr in Q. nra. }
  assert (0 <= k * k) by nra. pose proof (C a1 b1). pose proof (C a2 b2).
  replace (k * (a1 + b1) * (k * (a1 + b1))) with (k*k*((a1+b1)*(a1+b1))) in H1 by ring.
  replace (k * (a2 + b2) * (k * (a2 + b2))) with (k*k*((a2+b2)*(a2+b2))) in H2 by ring.
  assert (SS : (a1+b1)*(a1+b1) + (a2+b2)*(a2+b2) <= 5.83 * S) by (assert (0 <= S) by (unfold S; nra); lra).
  apply Rle_trans with (k*k*((a1+b1)*(a1+b1) + (a2+b2)*(a2+b2))). lra.
  replace (5.83 * (k*k) * S) with (k*k*(5.83*S)) by ring. apply Rmult_le_compat_l; assumption.
Qed.

(* g * (l0 + l1 i), rounded *)
Lemma lift_err g l0 l1 e k : 0 <= k ->
  Rabs (qw e) <= k * (Rabs (qw g * l0) + Rabs (qx g * l1) + Rabs (qw g * l0 - qx g * l1)) ->
  Rabs (qx e) <= k * (Rabs (qx g * l0) + Rabs (qw g * l1) + Rabs (qx g * l0 + qw g * l1)) ->
  Rabs (qy e) <= k * (Rabs (qy g * l0) + Rabs (qz g * l1) + Rabs (qy g * l0 + qz g * l1)) ->
  Rabs (qz e) <= k * (Rabs (qz g * l0) + Rabs (qy g * l1) + Rabs (qz g * l0 - qy g * l1)) ->
  q2n e <= 5.83 * (k*k) * (q2n g * (l0*l0 + l1*l1)).
Proof.
  intros Hk Hw Hx Hy Hz.
  pose proof (pair_err (qx g) (qw g) l0 l1 (qx e) (qw e) k Hk Hx Hw).
  pose proof (pair_err (qy g) (qz g) l0 l1 (qy e) (qz e) k Hk Hy Hz).
  unfold q2n. nra.
Qed.
(* (w1 i + w2 j + h k) * (t0 + t3 k), rounded, where the middle line is at least as near to e3 as to the plane *)
Lemma twist_err w1 w2 h t0 t3 e k : 0 <= k -> w1*w1 + w2*w2 <= 1.00001 * (h*h) ->
  Rabs (qx e) <= k * (Rabs (w1 * t0) + Rabs (w2 * t3) + Rabs (w1 * t0 + w2 * t3)) ->
  Rabs (qy e) <= k * (Rabs (w2 * t0) + Rabs (w1 * t3) + Rabs (w2 * t0 - w1 * t3)) ->
  Rabs (qz e) <= k * Rabs (h * t0) -> Rabs (qw e) <= k * Rabs (h * t3) ->
  q2n e <= 3.4151 * (k*k) * (q2n (q4 0 w1 w2 h) * (t0*t0 + t3*t3)).
Proof.
  intros Hk Hh Hx Hy Hz Hw.
  pose proof (pair_err w1 w2 t0 t3 (qx e) (qy e) k Hk Hx Hy) as P.
  apply sq_le in Hz. apply sq_le in Hw.
  assert (E : forall t, Rabs t * Rabs t = t * t) by (intro t; unfold Rabs; destruct (Rcase_abs t); ring).
  replace (k * Rabs (h*t0) * (k * Rabs (h*t0))) with (k*k*(Rabs (h*t0) * Rabs (h*t0))) in Hz by ring. rewrite E in Hz.
  replace (k * Rabs (h*t3) * (k * Rabs (h*t3))) with (k*k*(Rabs (h*t3) * Rabs (h*t3))) in Hw by ring. rewrite E in Hw.
  unfold q2n at 1. simpl. unfold q2n; simpl.
  set (S := k*k*(t0*t0+t3*t3)). assert (0 <= S) by (unfold S; apply Rmult_le_pos; nra).
  replace (3.4151 * (k*k) * ((0*0+w1*w1+w2*w2+h*h)*(t0*t0+t3*t3))) with (3.4151 * S * ((w1*w1+w2*w2)+h*h)) by (unfold
    S; ring).
  replace (5.83 * (k*k) * ((w1*w1+w2*w2)*(t0*t0+t3*t3))) with (5.83 * S * (w1*w1+w2*w2)) in P by (unfold S; ring).
  assert (qz e * qz e + qw e * qw e <= S * (h*h)) by (unfold S; nra).
  assert (5.83 * (w1*w1+w2*w2) + h*h <= 3.4151 * ((w1*w1+w2*w2)+h*h)) by nra.
  assert (S * (5.83 * (w1*w1+w2*w2) + h*h) <= S * (3.4151 * ((w1*w1+w2*w2)+h*h))) by (apply Rmult_le_compat_l;
    assumption).
  nra.
Qed.

(* the middle line with a height off by the factor 1 + eps: the start goes to the target's direction within 2 eps / (2
  + eps) *)
Definition unit3 := v3 0 0 1.
Lemma middle w1 w2 w3 l h s eps : s * s = 1 -> 0 < l -> l * l = w1*w1 + w2*w2 + w3*w3 -> 0 <= s * w3 ->
  h = (l + s * w3) * (1 + eps) -> -1/2 <= eps ->
  v2n (vsub (rot (q4 0 w1 w2 (s * h)) (vscale s unit3)) (vscale (/ l) (v3 w1 w2 w3))) <= (2 * eps / (2 + eps)) * (2 *
    eps / (2 + eps)).
Proof.
  intros Hs Hl El Hw Eh He. set (H := l + s * w3). assert (HH : 0 < H) by (unfold H; lra).
  set (rho2 := w1*w1 + w2*w2).
  assert (R0 : 0 <= rho2) by (unfold rho2; nra).
  assert (Hh : 0 < h) by (rewrite Eh; apply Rmult_lt_0_compat; [exact HH | lra]).
  assert (Er : rho2 = (l - s*w3) * H).
  { unfold rho2, H. assert (s*w3*(s*w3) = w3*w3) by (replace (s*w3*(s*w3)) with (s*s*(w3*w3)) by ring; rewrite Hs;
    ring). lra. }
  set (N := rho2 + h*h). assert (HN : 0 < N) by (unfold N; nra).
  assert (Eq2 : q2n (q4 0 w1 w2 (s*h)) = N).
  { unfold q2n, N, rho2; simpl. replace (s*h*(s*h)) with (s*s*(h*h)) by ring. rewrite Hs. ring. }
  (* the rotated start: (2 w1 h, 2 w2 h, s (h h - rho2)) / N *)
  assert (E : rot (q4 0 w1 w2 (s*h)) (vscale s unit3) = v3 (2*w1*h/N) (2*w2*h/N) (s*(h*h - rho2)/N)).
  { unfold rot. rewrite Eq2. unfold sand, vscale, unit3; simpl. f_equal.
    - replace (2*w1*h/N) with (/N * (s*s*(2*w1*h))) by (rewrite Hs; field; lra). field; lra.
    - replace (2*w2*h/N) with (/N * (s*s*(2*w2*h))) by (rewrite Hs; field; lra). field; lra.
    - replace (s*(h*h - rho2)/N) with (/N * (s*(s*s*(h*h) - rho2))) by (rewrite Hs; field; lra). unfold rho2.
      field; lra. }
  rewrite E. unfold v2n, vsub, vscale; simpl.
  (* square of the chord = 2 - 2 cos, with cos = (2 rho2 h + s w3 (h h - rho2)) / (N l) *)
  assert (Ew3 : w3 * w3 = l*l - rho2) by (unfold rho2; lra).
  set (z := s*w3). assert (Ez : w3 = s * z) by (unfold z; replace (s*(s*w3)) with (s*s*w3) by ring; rewrite Hs; ring).
  assert (Ez2 : z*z = l*l - rho2) by (unfold z; replace (s*w3*(s*w3)) with (s*s*(w3*w3)) by ring; rewrite Hs, Ew3;
    ring).
  assert (Hr' : rho2 = (l - z) * (l + z)) by lra.
  assert (Chord : (2*w1*h/N - /l*w1)*(2*w1*h/N - /l*w1) + (2*w2*h/N - /l*w2)*(2*w2*h/N - /l*w2) +
          (s*(h*h-rho2)/N - /l*w3)*(s*(h*h-rho2)/N - /l*w3) = 2 * rho2 * ((h - H)*(h - H)) / (N * (l * H))).
  { rewrite Ez.
    replace ((s*(h*h-rho2)/N - /l*(s*z))*(s*(h*h-rho2)/N - /l*(s*z))) with (s*s*(((h*h-rho2)/N - /l*z)*((h*h-rho2)/N -
      /l*z))) by (field; split; lra).
    rewrite Hs.
    replace ((2*w1*h/N - /l*w1)*(2*w1*h/N - /l*w1) + (2*w2*h/N - /l*w2)*(2*w2*h/N - /l*w2)) with (rho2 * ((2*h/N -
      /l)*(2*h/N-/l))) by (unfold rho2; field; split; lra).
    unfold N. assert (EH : H = l + z) by reflexivity. rewrite EH, Hr'. field.
      repeat split; try lra; try (rewrite <- EH; lra).
    rewrite <- Hr'. unfold N in HN. lra. }
  rewrite Chord.
  assert (EE : h - H = eps * H) by (rewrite Eh; unfold H; ring).
  rewrite EE.
  (* N * (2 l H) = (rho2 + h h)(rho2 + H H) >= rho2 (h + H)^2 = rho2 H H (2 + eps)^2 *)
  assert (EN : N * (2 * (l * H)) = (rho2 + h*h) * (rho2 + H*H)).
  { unfold N. f_equal. rewrite Er. unfold H. ring. }
  assert (C : rho2 * ((h + H)*(h + H)) <= N * (2 * (l*H))).
  { rewrite EN. pose proof (Rle_0_sqr (rho2 - h*H)) as Q. unfold Rsqr in Q. nra. }
  assert (Eh2 : h + H = (2 + eps) * H) by (rewrite Eh; unfold H; ring).
  rewrite Eh2 in C.
  assert (P1 : 0 < N * (l*H)) by (apply Rmult_lt_0_compat; [assumption | apply Rmult_lt_0_compat; assumption]).
  apply Rmult_le_reg_r with (N * (l*H)); [assumption|].
  replace (2*rho2*(eps*H*(eps*H))/(N*(l*H))*(N*(l*H))) with (2*rho2*(eps*H*(eps*H))) by (field; repeat split; lra).
  replace (2*eps/(2+eps)*(2*eps/(2+eps))*(N*(l*H))) with (2 * (eps*eps) * (N*(2*(l*H))) / ((2+eps)*(2+eps))) by (field;
    lra).
  apply Rmult_le_reg_r with ((2+eps)*(2+eps)); [nra|].
  replace (2*(eps*eps)*(N*(2*(l*H)))/((2+eps)*(2+eps))*((2+eps)*(2+eps))) with (2*(eps*eps)*(N*(2*(l*H)))) by (field;
    lra).
  assert (0 <= eps*eps) by nra. nra.
Qed.
